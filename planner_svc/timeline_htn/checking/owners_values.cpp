#include "planner_svc/timeline_htn/checking/owners_values.hpp"

#include <algorithm>

#include "planner_svc/timeline_htn/checking/version.hpp"

namespace roci::planner::timeline_htn::checking {

using engine::FunctionOutcome, engine::FunctionUse;
using temporal::FunctionValueUse;

namespace {

std::optional<std::vector<Index>> row_of(const model::Model& model, const model::NumberTable& table,
                                         const std::vector<std::string>& names) {
  if (names.size() != table.types.size()) return std::nullopt;
  std::vector<Index> out;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto object = std::ranges::find(model.objects, names[i], &model::Object::name);
    if (object == model.objects.end() || object->type != table.types[i]) return std::nullopt;
    out.push_back(static_cast<Index>(object - model.objects.begin()));
  }
  return out;
}

std::string text(const std::string& function, const std::vector<std::string>& arguments) {
  return engine::application({"", function, arguments});
}

bool gives(const FunctionUse& given, const FunctionValueUse& use) {
  return given.call.function == use.function && given.call.arguments == use.arguments &&
         given.answer.outcome == FunctionOutcome::value && given.answer.is_exact() &&
         given.answer.value == use.number && given.answer.provenance.owner == use.owner &&
         use.accuracy == temporal::FunctionAccuracy::exact;
}

}  // namespace

void put_values(std::span<const FunctionUse> values, model::Model& model) {
  for (model::NumberTable& table : model.numbers) {
    if (!table.asked) continue;
    table.asked->given = true;
    for (const FunctionUse& use : values) {
      if (use.call.module != table.asked->module || use.call.function != table.asked->function ||
          use.answer.outcome != FunctionOutcome::value || !use.answer.is_exact())
        continue;
      if (auto row = row_of(model, table, use.call.arguments))
        table.rows.insert_or_assign(std::move(*row), use.answer.value);
    }
  }
}

void check_values(const model::Model& model, const temporal::FlexiblePlan& plan,
                  std::span<const FunctionUse> values, std::vector<std::string>& out) {
  for (const FunctionValueUse& use : plan.function_values)
    if (std::ranges::none_of(values, [&](const FunctionUse& given) { return gives(given, use); }))
      out.push_back("the plan records " + text(use.function, use.arguments) + " = " +
                    temporal::to_text(use.number) + " of " + use.owner +
                    ", which did not say so in this call");
  const Version version = take_apart(model, plan, out);
  std::set<model::AskedNumber> read;
  for (const std::vector<Value>& timeline : version.timelines)
    for (const Value& value : timeline)
      add_asked(model, version.definition(value.state), value.state.objects, read);
  for (const Part& part : version.parts)
    if (part.state) add_asked(model, version.definition(*part.state), part.state->objects, read);
  for (const model::AskedNumber& number : read) {
    const model::NumberTable& table = model.numbers[number.table];
    std::vector<std::string> names;
    for (const Index object : number.row) names.push_back(model.objects[object].name);
    const auto records = [&](const FunctionValueUse& use) {
      return use.function == table.asked->function && use.arguments == names;
    };
    if (std::ranges::none_of(plan.function_values, records))
      out.push_back("the plan stands on " + text(table.asked->function, names) + " and does not record it");
  }
}

}  // namespace roci::planner::timeline_htn::checking
