#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "choices.hpp"
#include "option_values.hpp"

namespace meshcontour::app {

/// The group of the options that print something about the program instead of running it.
inline constexpr const char* kInformation = "Information";

/// What the parser knows of every option, and the words that some of them take: help, manual page and
/// completions are made of it.
struct OptionTable {
  CLI::App parser;
  std::map<const CLI::Option*, std::vector<std::string>> words;
};

/// The options of one group of the help.
class Group {
 public:
  Group(OptionTable& table, std::string name) : table_(table), name_(std::move(name)) {}

  CLI::Option* add_text(const std::string& names, std::string& target, const std::string& kind,
                        const std::string& help) {
    return table_.parser.add_option(names, target, help)->type_name(kind)->group(name_);
  }

  /// Can be repeated; takes one value each time.
  CLI::Option* add_list(const std::string& names, std::vector<std::string>& target, const std::string& kind,
                        const std::string& help) {
    return table_.parser.add_option(names, target, help)
        ->allow_extra_args(false)
        ->type_name(kind)
        ->group(name_);
  }

  CLI::Option* add_flag(const std::string& names, bool& target, const std::string& help) {
    return table_.parser.add_flag(names, target, help)->group(name_);
  }

  CLI::Option* add_action(const std::string& names, const std::function<void()>& action,
                          const std::string& help) {
    return table_.parser.add_flag_callback(names, action, help)->group(name_);
  }

  CLI::Option* add_parsed(const std::string& names, const std::string& kind,
                          const std::function<void(const std::string&)>& parse, const std::string& help) {
    return table_.parser.add_option_function<std::string>(names, parse, help)->type_name(kind)->group(name_);
  }

  /// Can be repeated; every value is parsed as it comes.
  CLI::Option* add_each(const std::string& names, const std::string& kind,
                        const std::function<void(const std::string&)>& parse, const std::string& help) {
    return add_parsed(names, kind, parse, help)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->trigger_on_parse();
  }

  /// One word of a table.
  template <class T, std::size_t N>
  CLI::Option* add_choice(const std::string& name, T& target, const Choices<T, N>& choices,
                          const std::string& help) {
    const auto parse = [&target, &choices, name](const std::string& text) {
      target = parse_choice(text, choices, name);
    };
    CLI::Option* option = add_parsed(name, "WORD", parse, fmt::format("{}: {}", help, words(choices)));
    return set_words(option, choices)->default_str(word_of(choices, target));
  }

  /// Several words of a table, with commas between them; `target` has the text.
  template <class T, std::size_t N>
  CLI::Option* add_words(const std::string& name, std::string& target, const Choices<T, N>& choices,
                         const std::string& help) {
    return set_words(add_text(name, target, "WORDS", fmt::format("{}: {}", help, words(choices))), choices);
  }

  /// Degrees for the user, radians inside; between 0 and `largest` degrees.
  CLI::Option* add_angle(const std::string& name, double& radians, double largest, const std::string& help) {
    constexpr double degree = std::numbers::pi / 180;
    const auto parse = [&radians, name, largest](const std::string& text) {
      const double degrees = parse_positive(text, name);
      if (degrees >= largest) refuse(name, text, fmt::format("degrees below {}", largest));
      radians = degrees * degree;
    };
    return add_parsed(name, "DEGREES", parse, help)->default_str(fmt::format("{:.6g}", radians / degree));
  }

  /// A whole number up to `largest`.
  template <class T>
  CLI::Option* add_count(const std::string& name, T& target, const std::string& help,
                         std::uint64_t largest = std::numeric_limits<T>::max()) {
    const auto parse = [&target, name, largest](const std::string& text) {
      target = static_cast<T>(parse_count(text, name, largest));
    };
    return add_parsed(name, "N", parse, help)->default_str(fmt::format("{}", target));
  }

 private:
  template <class T, std::size_t N>
  CLI::Option* set_words(CLI::Option* option, const Choices<T, N>& choices) {
    for (const auto& [word, value] : choices) table_.words[option].emplace_back(word);
    return option;
  }

  OptionTable& table_;
  std::string name_;
};

}  // namespace meshcontour::app
