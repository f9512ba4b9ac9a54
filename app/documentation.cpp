#include "documentation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "meshcontour/version.hpp"

namespace meshcontour::app {
namespace {

using Options = std::vector<const CLI::Option*>;

// Options with a name of their own, by group, in the order of the help.
std::vector<std::pair<std::string, Options>> groups_of(const OptionTable& table) {
  std::vector<std::pair<std::string, Options>> groups;
  for (const CLI::Option* option : table.parser.get_options()) {
    if (option->get_positional() || option->get_lnames().empty()) continue;
    const auto found =
        std::ranges::find(groups, option->get_group(), &std::pair<std::string, Options>::first);
    if (found == groups.end()) {
      groups.push_back({option->get_group(), {option}});
    } else {
      found->second.push_back(option);
    }
  }
  return groups;
}

bool takes_value(const CLI::Option* option) {
  return option->get_expected_max() > 0;
}

bool takes_file(const CLI::Option* option) {
  const std::string kind = option->get_type_name();
  return kind.ends_with("FILE") || kind == "JOURNAL";
}

const std::vector<std::string>& words_of(const OptionTable& table, const CLI::Option* option) {
  static const std::vector<std::string> none;
  const auto found = table.words.find(option);
  return found == table.words.end() ? none : found->second;
}

// "-o", "--output"
std::vector<std::string> names_of(const CLI::Option* option) {
  std::vector<std::string> names;
  for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size()) {
    text.replace(at, what.size(), by);
  }
  return text;
}

std::string roff(const std::string& text) {
  std::string out = replaced(replaced(text, "\\", "\\e"), "-", "\\-");
  if (out.starts_with('.') || out.starts_with('\'')) out.insert(0, "\\&");
  return replaced(out, "\n.", "\n\\&.");
}

std::string manual_entry(const CLI::Option* option) {
  std::string out =
      fmt::format(".TP\n\\fB{}\\fR", roff(fmt::format("{}", fmt::join(names_of(option), ", "))));
  if (takes_value(option)) out += fmt::format(" \\fI{}\\fR", roff(option->get_type_name()));
  out += "\n" + roff(option->get_description());
  if (!option->get_default_str().empty())
    out += roff(fmt::format(" (default: {})", option->get_default_str()));
  return out + "\n";
}

std::string bash_completion(const OptionTable& table) {
  std::string cases, all;
  for (const auto& [group, options] : groups_of(table)) {
    for (const CLI::Option* option : options) {
      const auto names = names_of(option);
      for (const std::string& name : names) all += (all.empty() ? "" : " ") + name;
      if (!takes_value(option)) continue;
      const auto& words = words_of(table, option);
      cases += fmt::format("    {}) ", fmt::join(names, "|"));
      cases += takes_file(option)
                   ? "compopt -o filenames; COMPREPLY=($(compgen -f -- \"$word\")) ;;\n"
                   : fmt::format("COMPREPLY=($(compgen -W '{}' -- \"$word\")) ;;\n", fmt::join(words, " "));
    }
  }
  return fmt::format(R"(# bash completion for meshcontour
_meshcontour() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}}
  COMPREPLY=()
  case $before in
{}    *)
      if [[ $word == -* ]]; then
        COMPREPLY=($(compgen -W '{}' -- "$word"))
      else
        compopt -o filenames
        COMPREPLY=($(compgen -f -- "$word"))
      fi ;;
  esac
}}
complete -F _meshcontour meshcontour
)",
                     cases, all);
}

std::string zsh_text(const std::string& text) {
  return replaced(replaced(replaced(replaced(text, "'", "'\\''"), "[", "\\["), "]", "\\]"), ":", "\\:");
}

std::string zsh_completion(const OptionTable& table) {
  std::string out = "#compdef meshcontour\n_arguments -s \\\n";
  for (const auto& [group, options] : groups_of(table)) {
    for (const CLI::Option* option : options) {
      const bool repeated = option->get_expected_max() > 1 || takes_file(option);
      for (const std::string& name : names_of(option)) {
        out += fmt::format("  '{}{}[{}]", repeated ? "*" : "", name, zsh_text(option->get_description()));
        if (takes_value(option)) {
          const auto& words = words_of(table, option);
          out += fmt::format(":{}:{}", zsh_text(option->get_type_name()),
                             takes_file(option) ? "_files" : fmt::format("({})", fmt::join(words, " ")));
        }
        out += "' \\\n";
      }
    }
  }
  return out + "  '*:input:_files'\n";
}

std::string fish_completion(const OptionTable& table) {
  std::string out = "# fish completion for meshcontour\n";
  for (const auto& [group, options] : groups_of(table)) {
    for (const CLI::Option* option : options) {
      out += "complete -c meshcontour";
      for (const std::string& name : option->get_snames()) out += " -s " + name;
      for (const std::string& name : option->get_lnames()) out += " -l " + name;
      if (takes_value(option)) out += takes_file(option) ? " -r -F" : " -x";
      const auto& words = words_of(table, option);
      if (!words.empty()) out += fmt::format(" -a '{}'", fmt::join(words, " "));
      out +=
          fmt::format(" -d '{}'\n", replaced(replaced(option->get_description(), "\\", "\\\\"), "'", "\\'"));
    }
  }
  return out;
}

std::string toml_text(const std::string& text) {
  return '"' + replaced(replaced(text, "\\", "\\\\"), "\"", "\\\"") + '"';
}

// "name = value"; a flag is true, a list has brackets.
std::string toml_line(const CLI::Option* option) {
  const std::string& name = option->get_lnames().front();
  if (!takes_value(option)) return fmt::format("{} = {}\n", name, option->count() > 0);
  if (option->count() == 0) return fmt::format("{} = {}\n", name, toml_text(option->get_default_str()));
  std::vector<std::string> values;
  for (const std::string& value : option->results()) values.push_back(toml_text(value));
  if (values.size() == 1) return fmt::format("{} = {}\n", name, values.front());
  return fmt::format("{} = [{}]\n", name, fmt::join(values, ", "));
}

}  // namespace

std::string manual_page(const OptionTable& table) {
  std::string out = fmt::format(R"(.TH MESHCONTOUR 1 "" "meshcontour {}" "User Commands"
.SH NAME
meshcontour \- contour curves of tessellated CAD models
.SH SYNOPSIS
.B meshcontour
[\fIOPTION\fR]... \fIINPUT\fR...
.SH DESCRIPTION
Finds the boundary loops of the patches of triangle meshes, turns them into lines, arcs and B\-splines, and writes
pictures, tables and CAD files. Without an output it prints what is in the file. Inputs are files or folders;
\- is standard input.
.SH OPTIONS
)",
                                version());
  for (const auto& [group, options] : groups_of(table)) {
    out += fmt::format(".SS {}\n", roff(group));
    for (const CLI::Option* option : options) out += manual_entry(option);
  }
  out += ".SH NOTES\n.nf\n" + roff(table.parser.get_footer()) + "\n.fi\n";
  out += R"(.SH EXAMPLES
.nf
meshcontour part.xml \-o part.png \-\-layers mesh,edges,curves
meshcontour bracket.stl \-o bracket.dxf
meshcontour parts/ \-o 'out/{stem}.csv' \-j 8 \-\-resume journal
.fi
)";
  return out;
}

std::string completion_script(const OptionTable& table, CommandShell shell) {
  switch (shell) {
    case CommandShell::Bash:
      return bash_completion(table);
    case CommandShell::Zsh:
      return zsh_completion(table);
    case CommandShell::Fish:
      return fish_completion(table);
  }
  return {};
}

std::string configuration(const OptionTable& table) {
  std::string out = "# Options of meshcontour; read it with --config.\n";
  for (const auto& [group, options] : groups_of(table)) {
    if (group == kInformation) continue;
    out += fmt::format("\n# {}\n", group);
    for (const CLI::Option* option : options) {
      out += fmt::format("# {}\n{}{}", option->get_description(), option->count() > 0 ? "" : "# ",
                         toml_line(option));
    }
  }
  return out;
}

}  // namespace meshcontour::app
