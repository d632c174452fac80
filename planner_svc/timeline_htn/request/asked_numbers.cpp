#include "planner_svc/timeline_htn/request/asked_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "planner_svc/engine/function_words.hpp"
#include "planner_svc/timeline_htn/model/bounds.hpp"

namespace roci::planner::timeline_htn::request {

using engine::FunctionCall, engine::FunctionOutcome, engine::FunctionUse;
using model::Index, model::Model, model::NumberTable;
using temporal::Verdict;

namespace {

using Rows = std::vector<std::vector<Index>>;

// Every row of objects of the types, the last position running fastest; nothing where there are too many.
std::optional<Rows> all_rows(const Model& model, const std::vector<Index>& types) {
  Rows rows{{}};
  for (const Index type : types) {
    Rows longer;
    for (const auto& row : rows)
      for (Index object = 0; object < model.objects.size(); ++object) {
        if (model.objects[object].type != type) continue;
        if (longer.size() >= model::kMostAsked) return std::nullopt;
        longer.push_back(row);
        longer.back().push_back(object);
      }
    rows = std::move(longer);
  }
  return rows;
}

std::optional<Rows> rows_to_ask(const Model& model, const NumberTable& table) {
  if (!table.asked->rows_of) return all_rows(model, table.types);
  const Rows& rows = model.relations[*table.asked->rows_of].rows;
  return rows.size() > model::kMostAsked ? std::nullopt : std::optional(rows);
}

FunctionCall call_of(const Model& model, const NumberTable& table, const std::vector<Index>& row) {
  FunctionCall out{table.asked->module, table.asked->function, {}};
  for (const Index object : row) out.arguments.push_back(model.objects[object].name);
  return out;
}

std::string place_of(const NumberTable& table) {
  return table.asked->place + ": number '" + table.name + "': ";
}

}  // namespace

Asked ask_numbers(Model& model, engine::FunctionSource& functions, const std::function<bool()>& cancelled) {
  Asked out;
  for (NumberTable& table : model.numbers) {
    if (!table.asked) continue;
    const auto rows = rows_to_ask(model, table);
    if (!rows)
      return {std::move(out.uses), Verdict::invalid_input,
              place_of(table) + "more than " + std::to_string(model::kMostAsked) +
                  " numbers would be asked for; name a relation in 'rows_of' whose rows alone are wanted, or "
                  "declare fewer objects"};
    table.rows.clear();
    table.asked->given = true;
    if (rows->empty()) continue;
    std::vector<FunctionCall> calls;
    for (const auto& row : *rows) calls.push_back(call_of(model, table, row));
    auto answers = functions.evaluate(calls, cancelled);
    if (cancelled())
      return {std::move(out.uses), Verdict::cancelled, "cancelled while waiting for external functions"};
    if (answers.size() != calls.size()) answers.assign(calls.size(), {});
    for (std::size_t i = 0; i < calls.size(); ++i) {
      FunctionUse use{calls[i], answers[i]};
      if (use.answer.outcome == FunctionOutcome::value && !std::isfinite(use.answer.value))
        use.answer.outcome = FunctionOutcome::not_a_number;
      if (const std::string fault = engine::fault_of(use); !fault.empty())
        return {std::move(out.uses), Verdict::function_unavailable,
                place_of(table) + fault + "; " + engine::remedy_of(use)};
      if (use.answer.outcome == FunctionOutcome::value) table.rows.emplace((*rows)[i], use.answer.value);
      out.uses.push_back(std::move(use));
    }
  }
  return out;
}

void put_recorded(const std::vector<temporal::FunctionValueUse>& recorded, Model& model) {
  for (NumberTable& table : model.numbers) {
    if (!table.asked) continue;
    table.asked->given = true;
    for (const temporal::FunctionValueUse& use : recorded) {
      if (use.function != table.asked->function || use.arguments.size() != table.types.size()) continue;
      std::vector<Index> row;
      for (const std::string& name : use.arguments) {
        const auto object = std::ranges::find(model.objects, name, &model::Object::name);
        if (object != model.objects.end() && object->type == table.types[row.size()])
          row.push_back(static_cast<Index>(object - model.objects.begin()));
        else
          break;
      }
      if (row.size() == table.types.size()) table.rows.insert_or_assign(std::move(row), use.number);
    }
  }
}

}  // namespace roci::planner::timeline_htn::request
