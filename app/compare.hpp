#pragma once

#include "outcome.hpp"

namespace meshcontour::app {

/// Runs every extractor on the model and puts a table of counts and times into the outcome. Where they
/// disagree on a manifold patch the outcome has failed, naming the patch.
void compare(const Model& model, const CommandLine& line, Outcome& outcome);

}  // namespace meshcontour::app
