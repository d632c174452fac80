#include "science_svc/background.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "science_svc/limits.hpp"

namespace roci::science {

using Covariance = Eigen::Matrix<double, kFeatures, kFeatures>;

namespace {

constexpr int kBands = 8;
constexpr double kNearestBand = 3;  // m
constexpr double kBandsPerOctave = 3;
constexpr double kWeightOfAll = 250;  // patches, with which what all bands show counts in each
constexpr double kRidge = 1e-3;       // keeps a covariance of flat images invertible
constexpr std::size_t kLeastPatches = 100;
constexpr double kQuantile = 0.95;
constexpr double kKept = 0.9;  // share that takes part in the second round

struct Moments {
  double count = 0;
  Features sum = Features::Zero();
  Covariance products = Covariance::Zero();

  void add(const Features& f) {
    count += 1;
    sum += f;
    products += f * f.transpose();
  }
};

double quantile(std::vector<double> values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

int Background::band_of(double range) {
  return std::clamp(static_cast<int>(kBandsPerOctave * std::log2(std::max(range, 0.1) / kNearestBand)) + 1, 0,
                    kBands - 1);
}

void Background::learn(const std::vector<Patch>& patches) {
  std::vector<Sample> samples;
  for (const Patch& one : patches) samples.push_back({band_of(one.range), one.features});
  images_.push_back(std::move(samples));
  if (images_.size() > kBackgroundImages) images_.pop_front();
  fit();
}

void Background::fit() {
  std::vector<Sample> all;
  for (const auto& image : images_) all.insert(all.end(), image.begin(), image.end());
  bands_.clear();
  if (all.size() < kLeastPatches) return;
  bands_ = fit_bands(all);
  const auto distances = [&] {
    std::vector<double> out;
    for (const Sample& one : all) out.push_back(distance(bands_, one));
    return out;
  };
  const std::vector<double> first = distances();
  const double most = quantile(first, kKept);
  std::vector<Sample> usual;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (first[i] <= most) usual.push_back(all[i]);
  bands_ = fit_bands(usual);
  quantile_ = quantile(distances(), kQuantile);
}

std::vector<Background::Band> Background::fit_bands(const std::vector<Sample>& samples) const {
  std::vector<Moments> moments(kBands);
  for (const Sample& one : samples) moments[static_cast<std::size_t>(one.band)].add(one.features);
  Moments all;
  for (const Moments& one : moments) {
    all.count += one.count;
    all.sum += one.sum;
    all.products += one.products;
  }
  const Features mean_of_all = all.sum / all.count;
  const Covariance scatter = all.products / all.count - mean_of_all * mean_of_all.transpose();
  std::vector<Band> out;
  for (const Moments& one : moments) {
    Band band;
    const double weight = one.count + kWeightOfAll;
    band.mean = (one.sum + kWeightOfAll * mean_of_all) / weight;
    // Scatter about the band's own mean, and kWeightOfAll patches of that of all.
    Covariance own = one.products - band.mean * one.sum.transpose() - one.sum * band.mean.transpose() +
                     one.count * band.mean * band.mean.transpose();
    const Covariance covariance = (own + kWeightOfAll * scatter) / weight + kRidge * Covariance::Identity();
    band.inverse = covariance.inverse();
    out.push_back(band);
  }
  return out;
}

double Background::distance(const std::vector<Band>& bands, const Sample& sample) {
  const Band& band = bands[static_cast<std::size_t>(sample.band)];
  const Features off = sample.features - band.mean;
  return std::max(0.0, off.dot(band.inverse * off));
}

std::vector<double> Background::scores(const std::vector<Patch>& patches) const {
  std::vector<double> out;
  for (const Patch& one : patches) {
    const double d = bands_.empty() ? 0 : distance(bands_, {band_of(one.range), one.features});
    out.push_back(d > 0 ? d / (d + std::max(quantile_, 1e-9)) : 0);
  }
  return out;
}

}  // namespace roci::science
