#include "help.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace meshcontour::app {
namespace {

constexpr std::size_t kColumns = 80, kTextColumn = 30;

// Breaks a text at its spaces; every line but the first starts at kTextColumn.
std::string wrapped(const std::string& text) {
  std::string out;
  std::size_t column = kTextColumn;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const bool first = begin == 0;
    if (!first && column + 1 + end - begin > kColumns) {
      out += "\n" + std::string(kTextColumn, ' ');
      column = kTextColumn;
    } else if (!first) {
      out += ' ';
      ++column;
    }
    out.append(text, begin, end - begin);
    column += end - begin;
    begin = end + 1;
  }
  return out;
}

class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter() { column_width(kTextColumn); }

  std::string make_option(const CLI::Option* option, bool is_positional) const override {
    std::string line = "  " + make_option_name(option, is_positional) + make_option_opts(option);
    line += line.size() + 2 > kTextColumn ? "\n" + std::string(kTextColumn, ' ')
                                          : std::string(kTextColumn - line.size(), ' ');
    return line + wrapped(make_option_desc(option)) + "\n";
  }

  std::string make_group(std::string group, bool is_positional,
                         std::vector<const CLI::Option*> options) const override {
    std::string out = (is_positional ? "\n" : "") + group + ":\n";
    for (const CLI::Option* option : options) out += make_option(option, is_positional);
    if (is_positional) out += "\n";
    return out;
  }
};

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::shared_ptr<CLI::Formatter> help_formatter() {
  return std::make_shared<HelpFormatter>();
}

std::string nearest_option(const CLI::App& parser, std::string_view typed) {
  constexpr std::size_t longest = 64;  // nobody mistypes more
  typed = typed.substr(0, typed.find('='));
  std::string nearest;
  std::size_t least = typed.size() > longest ? 0 : std::max<std::size_t>(2, typed.size() / 3) + 1;
  for (const CLI::Option* option : parser.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      const std::size_t distance = edit_distance(typed, "--" + name);
      if (distance < least) {
        least = distance;
        nearest = "--" + name;
      }
    }
  }
  return nearest;
}

}  // namespace meshcontour::app
