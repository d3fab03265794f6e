#include <algorithm>
#include <cctype>
#include <numeric>

#include "framework/plugin/registry.h"

namespace dvrlab {
namespace {

std::string lower(std::string word) {
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return word;
}

/// Letters changed, added, left out, or swapped with their neighbour.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before.swap(above);
    above.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1), above[j] + 1, row[j - 1] + 1});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row.back();
}

}  // namespace

std::string nearest_name(const std::string& word, const std::vector<std::string>& legal) {
  const std::string wanted = lower(word);
  // A third of the letters may be wrong: more is another word, and a wrong guess is worse than none.
  std::size_t best = std::max<std::size_t>(1, wanted.size() / 3) + 1;
  std::string nearest;
  for (const std::string& name : legal) {
    const std::string candidate = lower(name);
    const bool begun = wanted.size() >= 3 && candidate.compare(0, wanted.size(), wanted) == 0;
    const std::size_t distance = begun ? 1 : edit_distance(wanted, candidate);
    if (distance < best) {
      best = distance;
      nearest = name;
    }
  }
  return nearest;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& legal) {
  const std::string nearest = nearest_name(word, legal);
  return nearest.empty() ? "" : " (did you mean '" + nearest + "'?)";
}

}  // namespace dvrlab
