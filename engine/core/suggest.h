// "Did you mean ...": the known name nearest to a mistyped one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gridshell {

/// Letters inserted, left out, changed, or swapped with a neighbour, at least how many
/// (optimal string alignment distance); upper and lower case count as the same letter.
int edit_distance(std::string_view a, std::string_view b);

/// The nearest of `known` to `word` when it is near enough to be meant (a third of its letters, at
/// least one, wrong, or the rest of it missing), else empty. Ties go to the first.
std::string nearest(std::string_view word, const std::vector<std::string>& known);

/// "; did you mean 'x'?", or empty when nothing is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

}  // namespace gridshell
