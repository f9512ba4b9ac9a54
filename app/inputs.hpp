#pragma once

#include <string>
#include <utility>
#include <vector>

namespace meshcontour::app {

/// The files that the inputs stand for: of a folder all readable models in it and below, sorted; the rest as
/// they are.
///
/// @throws Error  NoInput if a folder cannot be listed or holds no model.
std::vector<std::string> expand_inputs(const std::vector<std::string>& inputs);

/// Every count-th input from the number-th on, as in --shard 2/8: the parts of an array job.
///
/// @param shard  number from 1 and count; {1, 1}: all.
std::vector<std::string> take_shard(const std::vector<std::string>& inputs,
                                    std::pair<std::size_t, std::size_t> shard);

}  // namespace meshcontour::app
