#include "render/gl_module.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <optional>

namespace meshcontour::detail {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDirectoryVariable = "MESHCONTOUR_GL_MODULES";
constexpr int kFoldersAbove = 4;
constexpr std::array kPrefixes = {MESHCONTOUR_GL_MODULE_PREFIX, "/usr/local",
                                  "/usr"};  // for programs elsewhere

struct Module {
  const char* name;
  const char* package;  // of Debian
};

Module module_of(GlBackend backend) {
  return backend == GlBackend::Egl ? Module{"egl", "libegl1, libgl1-mesa-dri and libglu1-mesa"}
                                   : Module{"osmesa", "libosmesa6 and libglu1-mesa"};
}

std::optional<uid_t> owner(const fs::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) return std::nullopt;
  return status.st_uid;
}

// Where the module may lie; only files that exist, and that nobody else could have put there.
std::vector<fs::path> candidates(const std::string& file) {
  if (const char* directory = std::getenv(kDirectoryVariable); directory != nullptr && *directory != '\0') {
    return {fs::path(directory) / file};
  }
  std::vector<fs::path> found;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const auto add = [&](const fs::path& candidate) {
    const auto uid = owner(candidate);
    if (uid && (uid == uid_t{0} || uid == owner(program))) found.push_back(candidate);
  };
  fs::path folder = program.parent_path();
  for (int i = 0; !error && i <= kFoldersAbove; ++i, folder = folder.parent_path()) {
    add(folder / MESHCONTOUR_GL_MODULE_FOLDER / file);
    if (folder == folder.root_path()) break;
  }
  for (const char* prefix : kPrefixes) add(fs::path(prefix) / MESHCONTOUR_GL_MODULE_FOLDER / file);
  return found;
}

const GlApi* open(const fs::path& file, std::string& failure) {
  void* handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (handle == nullptr) {
    failure = dlerror();
    return nullptr;
  }
  using Entry = const void* (*)();
  const auto entry = reinterpret_cast<Entry>(dlsym(handle, kGlApiSymbol));
  const auto* api = entry == nullptr ? nullptr : static_cast<const GlApi*>(entry());
  if (api == nullptr || api->version != kGlApiVersion) {
    failure = file.string() + " belongs to another version";
    return nullptr;
  }
  return api;
}

}  // namespace

const char* backend_name(GlBackend backend) {
  return module_of(backend).name;
}

std::vector<GlBackend> backends(GlBackend wanted) {
  if (wanted == GlBackend::Automatic) return {GlBackend::OSMesa, GlBackend::Egl};
  return {wanted};
}

const GlApi* load_gl_module(GlBackend backend, std::string& failure) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  static const GlApi* loaded[2] = {nullptr, nullptr};
  const Module module = module_of(backend);
  const GlApi*& api = loaded[backend == GlBackend::Egl ? 1 : 0];
  if (api != nullptr) return api;
  const std::string file = fmt::format("meshcontour-gl-{}.so", module.name);
  std::string why = fmt::format("no {} in {} beside the program, above it or in {}", file,
                                MESHCONTOUR_GL_MODULE_FOLDER, fmt::join(kPrefixes, ", "));
  for (const fs::path& candidate : candidates(file)) {
    api = open(candidate, why);
    if (api != nullptr) return api;
  }
  failure += fmt::format("{}{}: {} (Debian packages {})", failure.empty() ? "" : "; ", module.name,
                         printable(why), module.package);
  return nullptr;
}

}  // namespace meshcontour::detail
