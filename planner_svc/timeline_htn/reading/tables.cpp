#include <algorithm>
#include <cmath>

#include "planner_svc/timeline_htn/model/bounds.hpp"
#include "planner_svc/timeline_htn/reading/sections.hpp"

namespace roci::planner::timeline_htn::reading {

using mission::Entry;
using model::Index;

namespace {

std::size_t rows_of(const model::Model& model) {
  std::size_t out = 0;
  for (const auto& relation : model.relations) out += relation.rows.size();
  for (const auto& numbers : model.numbers) out += numbers.rows.size();
  return out;
}

// Declares a table where the entry has its arguments; `own` is the key that tables of this kind alone have.
void declare(const std::string& name, const Entry& entry, Names& names, Vocabulary& vocabulary,
             std::string_view own, const std::function<void(std::vector<Index>)>& add) {
  entry.allow_only({"arguments", "symmetric", "rows", own});
  const auto arguments = entry.find("arguments");
  if (!arguments) return;
  std::vector<Index> types;
  for (const Entry& type : items(*arguments, model::kMostParameters))
    types.push_back(vocabulary.type(type.text(), type));
  if (types.empty()) arguments->fail("a table has at least one argument; name its type");
  if (names.size() >= model::kMostTables)
    entry.fail("more than " + std::to_string(model::kMostTables) + " tables of this kind; join some");
  names.add(name, entry);
  add(std::move(types));
}

// Reads each row: objects of these types, then `more` entries.
void each_row(const Entry& entry, const std::vector<Index>& types, std::size_t more, Vocabulary& vocabulary,
              const std::function<void(const std::vector<Index>&, const std::vector<Entry>&)>& take) {
  const bool symmetric = entry.truth_or("symmetric", false);
  if (symmetric && (types.size() != 2 || !may_be_same(types[0], types[1])))
    entry.at("symmetric").fail("only a table with two arguments of one type is symmetric; take the word out");
  const auto rows = entry.find("rows");
  if (!rows) return;
  const std::vector<Entry> all = rows->items();
  if (rows_of(vocabulary.model) + all.size() * (symmetric ? 2 : 1) > model::kMostRows)
    rows->fail("more than " + std::to_string(model::kMostRows) +
               " rows in all tables; make the model smaller");
  Scope none;
  for (const Entry& row : all) {
    row.attempt([&] {
      const std::vector<Entry> cells = items(row, model::kMostParameters + 1);
      if (cells.size() != types.size() + more)
        row.fail(
            "the row has " + std::to_string(cells.size()) + " entries, " +
            std::to_string(types.size() + more) + " are expected: " +
            (more == 0 ? "an object for each argument" : "an object for each argument, then the number"));
      std::vector<Index> objects;
      for (std::size_t i = 0; i < types.size(); ++i)
        objects.push_back(vocabulary.term(cells[i].text(), types[i], none, cells[i]).index);
      take(objects, cells);
      if (!symmetric) return;
      std::swap(objects[0], objects[1]);
      take(objects, cells);
    });
  }
}

// Who is asked for the numbers of the table that was declared last.
model::AskedNumbers asked_numbers(const Entry& entry, const Vocabulary& vocabulary) {
  entry.allow_only({"module", "function", "rows_of"});
  const model::NumberTable& table = vocabulary.model.numbers.back();
  model::AskedNumbers out{
      entry.at("module").text(), entry.text_or("function", table.name), {}, entry.place()};
  if (const auto relation = entry.find("rows_of")) {
    out.rows_of = vocabulary.relations.index(relation->text(), *relation);
    if (!std::ranges::equal(vocabulary.model.relations[*out.rows_of].types, table.types, may_be_same))
      relation->fail("relation '" + relation->text() + "' is of other types than '" + table.name +
                     "'; name one with the same arguments, or none");
  }
  return out;
}

}  // namespace

void read_types(const Entry& section, Vocabulary& vocabulary) {
  for (const Entry& type : items(section, model::kMostTypes)) {
    type.attempt([&] {
      if (vocabulary.types.size() >= model::kMostTypes)
        type.fail("more than " + std::to_string(model::kMostTypes) + " types; join some");
      vocabulary.types.add(type.text(), type);
      vocabulary.model.types.push_back(type.text());
    });
  }
}

void read_objects(const Entry& section, Vocabulary& vocabulary) {
  section.each_field([&](const std::string& type, const Entry& list) {
    const Index index = vocabulary.type(type, list);
    for (const Entry& object : items(list, model::kMostObjects)) {
      object.attempt([&] {
        if (vocabulary.objects.size() >= model::kMostObjects)
          object.fail("more than " + std::to_string(model::kMostObjects) +
                      " objects; make the model smaller");
        vocabulary.objects.add(object.text(), object);
        vocabulary.model.objects.push_back({object.text(), index});
      });
    }
  });
}

void declare_relations(const Entry& section, Vocabulary& vocabulary) {
  section.each_field([&](const std::string& name, const Entry& entry) {
    declare(name, entry, vocabulary.relations, vocabulary, "observed", [&](std::vector<Index> types) {
      model::Relation& relation = vocabulary.model.relations.emplace_back();
      relation.name = name;
      relation.types = std::move(types);
      if (const auto observed = entry.find("observed")) {
        observed->allow_only({"timeline", "value"});
        relation.timeline = observed->at("timeline").text();
        relation.value = observed->at("value").text();
      }
    });
  });
}

void declare_numbers(const Entry& section, Vocabulary& vocabulary) {
  section.each_field([&](const std::string& name, const Entry& entry) {
    declare(name, entry, vocabulary.numbers, vocabulary, "asked", [&](std::vector<Index> types) {
      vocabulary.model.numbers.push_back({name, std::move(types), {}});
      if (const auto asked = entry.find("asked"))
        vocabulary.model.numbers.back().asked = asked_numbers(*asked, vocabulary);
    });
  });
}

void read_relations(const Entry& section, Vocabulary& vocabulary) {
  auto& relations = vocabulary.model.relations;
  section.each_field([&](const std::string& name, const Entry& entry) {
    const Index index = vocabulary.relations.index(name, entry);
    const std::vector<Index> types = relations[index].types;
    each_row(entry, types, 0, vocabulary, [&](const std::vector<Index>& objects, const std::vector<Entry>&) {
      relations[index].rows.push_back(objects);
    });
  });
}

void read_numbers(const Entry& section, Vocabulary& vocabulary) {
  auto& numbers = vocabulary.model.numbers;
  section.each_field([&](const std::string& name, const Entry& entry) {
    const Index index = vocabulary.numbers.index(name, entry);
    const std::vector<Index> types = numbers[index].types;
    if (numbers[index].asked) {
      for (const char* key : {"rows", "symmetric"})
        if (const auto own = entry.find(key))
          own->fail("a service is asked for the numbers of '" + name + "', at " +
                    numbers[index].asked->place + "; take this out, or 'asked'");
      return;
    }
    each_row(entry, types, 1, vocabulary,
             [&](const std::vector<Index>& objects, const std::vector<Entry>& cells) {
               const double number = cells.back().number();
               const auto [row, added] = numbers[index].rows.emplace(objects, number);
               if (!added && row->second != number)
                 cells.back().fail("the table has another number for these objects already; keep one");
             });
  });
}

void finish_tables(Vocabulary& vocabulary) {
  for (model::Relation& relation : vocabulary.model.relations) {
    std::ranges::sort(relation.rows);
    const auto doubled = std::ranges::unique(relation.rows);
    relation.rows.erase(doubled.begin(), doubled.end());
  }
}

}  // namespace roci::planner::timeline_htn::reading
