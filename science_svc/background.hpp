// The background is what ground usually looks like, learnt from the images of this run, and how far a patch
// is from it.
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <deque>
#include <vector>

#include "science_svc/patches.hpp"

namespace roci::science {

/// Implements the anomaly detector of Reed and Yu, "Adaptive multiple-band CFAR detection of an optical pattern with
/// unknown spectral distribution", IEEE Trans. Acoustics, Speech, and Signal Processing 38 (1990), known as RX, on
/// features of patches instead of spectral bands: the squared Mahalanobis distance of a patch from the mean of the
/// background. On images of Mars it is one of the peers in Kerner et al., "Comparison of novelty detection methods for
/// multispectral images in rover-based planetary exploration missions", Data Mining and Knowledge Discovery 34 (2020).
/// Texture depends on how far away ground lies, so the background has a mean and a covariance for each band of ranges,
/// drawn towards those of all ranges where little was seen; what lies far off takes no part in a second round, so that
/// a target does not hide itself.
class Background {
 public:
  /// Takes an image's patches into the background; the oldest image goes when there are more than kBackgroundImages.
  void learn(const std::vector<Patch>&);

  /// Returns how many images it holds.
  std::size_t images() const { return images_.size(); }

  /// Returns a score for each patch, in [0, 1): d / (d + q) with the patch's squared distance d and the 95 % quantile q
  /// of what was learnt. 0.5 is as odd as the oddest twentieth of the ground seen so far.
  /// All are 0 while hardly anything was learnt.
  std::vector<double> scores(const std::vector<Patch>&) const;

 private:
  struct Band {
    Features mean = Features::Zero();
    Eigen::Matrix<double, kFeatures, kFeatures> inverse =
        Eigen::Matrix<double, kFeatures, kFeatures>::Identity();
  };
  struct Sample {
    int band = 0;
    Features features;
  };

  static int band_of(double range);
  void fit();
  std::vector<Band> fit_bands(const std::vector<Sample>&) const;
  static double distance(const std::vector<Band>&, const Sample&);

  std::deque<std::vector<Sample>> images_;
  std::vector<Band> bands_;
  double quantile_ = 0;
};

}  // namespace roci::science
