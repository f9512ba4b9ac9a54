#pragma once

#include <algorithm>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "meshcontour/report.hpp"

namespace meshcontour::app {

/// Keeps the models of a page within its limit: those of the first inputs, in whatever order they come.
class ModelLimit {
 public:
  /// Leaves out what is too much once the report of that input has come.
  void apply(std::vector<FileReport>& reports, std::size_t job) {
    if (reports[job].preview.model.empty()) return;
    kept_.insert(job);
    total_ += reports[job].preview.model_size;
    while (!kept_.empty() && (total_ > kLargestPageModels || *kept_.rbegin() >= first_left_out_)) {
      const std::size_t last = *kept_.rbegin();
      first_left_out_ = std::min(first_left_out_, last);
      total_ -= reports[last].preview.model_size;
      reports[last].preview.model = std::string();
      kept_.erase(last);
    }
  }

 private:
  std::set<std::size_t> kept_;
  std::uint64_t total_ = 0;
  std::size_t first_left_out_ = std::numeric_limits<std::size_t>::max();
};

}  // namespace meshcontour::app
