// What `choose` says: table, rows and chart.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/choice_search.h"
#include "experiments/experiment.h"

namespace twinshade {

enum class Cost { memory, speed };

// What is within the error, best first, and what was chosen of it.
struct Ranking {
  std::vector<std::size_t> order;     // of SearchResult::best, the cheapest first
  std::vector<std::size_t> frontier;  // of those, which are not beaten in both memory and speed
};

// Fewest bytes, of equal ones the least error, so that clocks do not decide; or fastest.
Ranking rank(const SearchResult& found, Cost by);

// What is within the error, best first: the cheapest, and those that are cheaper by the other cost.
std::string within_table(const SearchResult& found, const Ranking& ranking);
// Where nothing is: what comes closest, of each technique the best.
std::string closest_table(const SearchResult& found);
// The one with the least error of all that were tried; nothing where none has an error.
std::optional<std::size_t> closest(const SearchResult& found);

// What was tried, in order. Shading has been timed of SearchResult::best alone.
Rows choice_rows(const SearchResult& found, const Ranking& ranking, double max_error);
std::vector<Picture> choice_pictures(const SearchResult& found, double max_error, const std::string& what);

std::string memory_words(std::uint64_t bytes);
// "sh3 (volume 8x4x8, half)"
std::string words(const Choice& choice);

}  // namespace twinshade
