#include "tests/engines/table.hpp"

#include "tests/engines/answering/search_checker.hpp"
#include "tests/engines/answering/search_engine.hpp"
#include "tests/engines/stepped/chain_checker.hpp"
#include "tests/engines/stepped/chain_engine.hpp"

namespace roci::planner::proof {

const engine::Table& engines() {
  static const engine::Table table{
      {"search",
       {engine::MakeAnswering([] { return std::make_unique<SearchEngine>(); }),
        [] { return std::make_unique<SearchChecker>(); }}},
      {"chain",
       {engine::MakeStepped([](const engine::Setup& setup) { return std::make_unique<ChainEngine>(setup); }),
        [] { return std::make_unique<ChainChecker>(); }}},
  };
  return table;
}

}  // namespace roci::planner::proof
