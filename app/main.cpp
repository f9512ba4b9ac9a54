#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <new>

#include "batch.hpp"
#include "command_line.hpp"
#include "meshcontour/error.hpp"

namespace {

int fail(meshcontour::ErrorCode code, std::string_view message) {
  fmt::print(stderr, "meshcontour: {}\n", message);
  return static_cast<int>(code);
}

}  // namespace

int main(int argc, char** argv) {
  using meshcontour::ErrorCode;
  try {
    const auto command_line = meshcontour::app::parse_command_line(argc, argv);
    return command_line ? meshcontour::app::run(*command_line) : 0;
  } catch (const meshcontour::Error& error) {
    return fail(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "out of memory");
  } catch (const std::exception& error) {
    return fail(ErrorCode::Internal, fmt::format("internal error: {}", error.what()));
  }
}
