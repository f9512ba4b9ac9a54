#include "render/stroke_font.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace meshcontour::detail {
namespace {

constexpr double kHeight = 6, kAdvance = 6, kGap = 2;  // of the grid

// Polylines on a grid of 5 columns and 7 rows: a digit for x and one for y a point, a space between
// polylines.
constexpr std::array<std::pair<char, std::string_view>, 27> kGlyphs = {{
    {'0', "103041453616050110"},
    {'1', "152620 1030"},
    {'2', "05163645440040"},
    {'3', "064624344341301001"},
    {'4', "30360242"},
    {'5', "460604344341301001"},
    {'6', "453616050110304143341403"},
    {'7', "064610"},
    {'8', "13040516364544331302011030414233"},
    {'9', "0110304145361605031242"},
    {'.', "2021"},
    {'-', "0343"},
    {'+', "0343 2125"},
    {'e', "024243341403011040"},
    {'c', "441403011040"},
    {'d', "46401001031444"},
    {'f', "10152646 0434"},
    {'i', "2024 2526"},
    {'k', "0006 440240"},
    {'l', "2026"},
    {'m', "0004 03142320 23344340"},
    {'n', "0004 0314344340"},
    {'t', "16112040 0434"},
    {'u', "0401103041 4440"},
    {'X', "0046 0640"},
    {'Y', "062346 2320"},
    {'Z', "06460040"},
}};

std::string_view glyph(char letter) {
  const auto found = std::ranges::find(kGlyphs, letter, &std::pair<char, std::string_view>::first);
  return found == kGlyphs.end() ? std::string_view() : found->second;
}

}  // namespace

std::vector<Eigen::Vector2d> text_strokes(std::string_view text) {
  std::vector<Eigen::Vector2d> ends;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string_view strokes = glyph(text[i]);
    const auto at = [&](std::size_t k) -> Eigen::Vector2d {
      return Eigen::Vector2d(kAdvance * static_cast<double>(i) + (strokes[k] - '0'), strokes[k + 1] - '0') /
             kHeight;
    };
    for (std::size_t k = 0; k + 3 < strokes.size();) {
      if (strokes[k + 2] == ' ') {
        k += 3;
        continue;
      }
      ends.push_back(at(k));
      ends.push_back(at(k + 2));
      k += 2;
    }
  }
  return ends;
}

double text_width(std::string_view text) {
  return text.empty() ? 0 : (kAdvance * static_cast<double>(text.size()) - kGap) / kHeight;
}

}  // namespace meshcontour::detail
