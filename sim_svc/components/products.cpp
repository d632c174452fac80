#include "sim_svc/components/products.hpp"

#include <algorithm>
#include <cmath>

#include "core/words/nearest_word.hpp"
#include "sim_svc/components/argument_slots.hpp"
#include "sim_svc/setup/roster_file.hpp"

namespace roci::sim::components {

using mission::Entry;
using world::Ending;
using world::Failure;

namespace {

constexpr double kMostBytes = 1e15;
constexpr double kSmallest = 0.1;  // share of a size that noise leaves at least

constexpr double kLeastFactor = 1e-3;

world::Tier tier_of(const std::string& name, const Entry& entry) {
  if (const auto tier = world::tier_named(name)) return *tier;
  const std::vector<std::string> known{"critical", "decisional", "mandatory", "residual"};
  entry.fail("unknown tier '" + name + "'; known: critical, decisional, mandatory, residual" +
             words::did_you_mean(name, known));
}

ProductForm read_product(const std::string& kind, const Entry& entry) {
  entry.allow_only({"tier", "bytes", "bytes_noise", "utility"});
  ProductForm out{kind};
  if (kind.empty()) entry.fail("a product needs a kind; name it");
  if (const auto tier = entry.find("tier")) out.tier = tier_of(tier->text(), *tier);
  out.bytes = setup::number(entry, "bytes", out.bytes, 1);
  if (out.bytes > kMostBytes) entry.at("bytes").fail("is more than anybody could send; correct the number");
  out.bytes_noise = setup::number(entry, "bytes_noise", out.bytes_noise);
  if (const auto utility = entry.find("utility"))
    utility->each([&](const Entry& score) { out.utility.push_back(score.number()); });
  return out;
}

}  // namespace

std::vector<ProductForm> read_products(const Entry& entry, const std::string& command,
                                       const std::vector<std::string>& arguments) {
  std::vector<ProductForm> out;
  entry.each_field([&](const std::string& kind, const Entry& product) {
    check_slots(product, kind, command, arguments);
    out.push_back(read_product(kind, product));
  });
  std::ranges::stable_sort(out, {}, &ProductForm::tier);
  return out;
}

void apply_data_factor(setup::Settings& in, std::vector<ProductForm>& forms) {
  const auto entry = in.find("data_factor");
  if (!entry) return;
  std::map<world::Tier, double> factors;
  const auto factor_in = [](const Entry& factor) {
    const double value = factor.number();
    if (value < kLeastFactor || value > 1 / kLeastFactor)
      factor.fail("a factor of data lies between 0.001 and 1000; correct the number");
    return value;
  };
  if (entry->is_mapping()) {
    for (const auto& [name, factor] : entry->fields()) factors[tier_of(name, factor)] = factor_in(factor);
  } else {
    for (int tier = 0; tier <= static_cast<int>(world::Tier::residual); ++tier)
      factors[static_cast<world::Tier>(tier)] = factor_in(*entry);
  }
  for (ProductForm& form : forms)
    if (const auto factor = factors.find(form.tier); factor != factors.end()) form.bytes *= factor->second;
}

std::map<std::string, std::vector<ProductForm>> read_products_by_command(
    setup::Settings& in, const std::vector<world::CommandForm>& commands) {
  std::map<std::string, std::vector<ProductForm>> out;
  std::vector<std::string> known;
  for (const world::CommandForm& one : commands) known.push_back(one.name);
  if (const auto all = in.find("products"))
    all->each_field([&](const std::string& name, const Entry& products) {
      const auto command = std::ranges::find(commands, name, &world::CommandForm::name);
      if (command == commands.end())
        products.fail("no command '" + name + "'; known: " + setup::known_names(name, known));
      out[name] = read_products(products, name, command->arguments);
    });
  for (auto& [command, forms] : out) apply_data_factor(in, forms);
  if (out.empty()) in.find("data_factor");  // a scenario's world may say it, whatever there is
  return out;
}

Ending make_products(const std::vector<ProductForm>& forms, const world::TaskKey& key,
                     const std::map<std::string, std::string>& arguments, double content, temporal::Time now,
                     world::RandomStream& noise, world::Surroundings& around) {
  if (forms.empty()) return std::nullopt;
  if (!around.body.data)
    return Failure{"no-store", around.robot + " cannot keep data; give it data: in mission.yaml"};
  std::string refused;
  for (const ProductForm& form : forms) {
    const double drawn = form.bytes_noise > 0 ? form.bytes_noise * noise.normal() : 0;
    world::Product product;
    product.kind = fill_slots(form.kind, arguments);
    product.robot = around.robot;
    product.source = key.activity;
    product.bytes =
        static_cast<std::uint64_t>(std::max(1.0, form.bytes * content * std::max(kSmallest, 1 + drawn)));
    product.tier = form.tier;
    product.created = now;
    product.utility = form.utility;
    const std::string kind = product.kind;
    if (auto kept = around.body.data->add(std::move(product)))
      around.out.push_back(std::move(*kept));
    else
      refused += (refused.empty() ? "" : ", ") + kind;
  }
  if (refused.empty()) return std::nullopt;
  return Failure{"data-full", "there is no room on board for " + refused + "; send or discard data first"};
}

}  // namespace roci::sim::components
