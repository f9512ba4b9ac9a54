#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "meshcontour/error.hpp"

namespace meshcontour::detail {

/// The message of an error without its spot.
inline std::string message_of(const Error& error) {
  const std::string where = error.spot().text();
  return std::string(error.what()).substr(where.empty() ? 0 : where.size() + 2);
}

/// Collects what a reader mends: one line a kind, with the place of the first and the count of all.
class Findings {
 public:
  using Severity = Diagnostic::Severity;

  /// @param kind      tells kinds apart.
  /// @param describe  called for the first of its kind only: gives the message and the place, as a
  /// Diagnostic.
  template <typename Describe>
  void add(std::string_view kind, const Describe& describe, std::size_t count = 1) {
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
      if (kinds_[i] != kind) continue;
      diagnostics_[i].count += count;
      return;
    }
    Diagnostic diagnostic = describe();
    diagnostic.count = count;
    kinds_.emplace_back(kind);
    diagnostics_.push_back(std::move(diagnostic));
  }

  /// @param describe  gives the message and the place, as a pair; called for the first of its kind only.
  template <typename Describe>
  void warn(std::string_view kind, const Describe& describe) {
    add(kind, [&] { return made(Severity::Warning, describe()); });
  }

  template <typename Describe>
  void note(std::string_view kind, const Describe& describe) {
    add(kind, [&] { return made(Severity::Note, describe()); });
  }

  /// Appends another collection's findings, kind by kind.
  void merge(const Findings& other) {
    for (std::size_t i = 0; i < other.kinds_.size(); ++i) {
      add(
          other.kinds_[i], [&] { return other.diagnostics_[i]; }, other.diagnostics_[i].count);
    }
  }

  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  static Diagnostic made(Severity severity, std::pair<std::string, Spot> what) {
    return {severity, std::move(what.first), std::move(what.second), 1};
  }

  std::vector<std::string> kinds_;
  std::vector<Diagnostic> diagnostics_;
};

}  // namespace meshcontour::detail
