#include "base/input_file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <string>
#include <thread>

#include "meshcontour/error.hpp"
#include "support/catch.hpp"

using namespace meshcontour;
using namespace meshcontour::detail;
namespace fs = std::filesystem;

namespace {

// A folder of its own for a test, removed at the end.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("meshcontour_input_" + std::to_string(::getpid()))) {
    fs::remove_all(path_);
    fs::create_directories(path_ / "model" / "parts");
    write(path_ / "outside.xml", "secret");
    write(path_ / "model" / "in.xml", "content");
    write(path_ / "model" / "parts" / "deep.xml", "deep");
  }
  ~Folder() { fs::remove_all(path_); }
  fs::path operator/(const char* name) const { return path_ / name; }
  static void write(const fs::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
  }

 private:
  fs::path path_;
};

ErrorCode code_of(const fs::path& file) {
  try {
    InputFile opened(file);
  } catch (const Error& error) {
    return error.code();
  }
  return ErrorCode::Internal;
}

}  // namespace

TEST_CASE("InputFile: a regular file gives its bytes, its head first", "[base]") {
  const Folder folder;
  const std::size_t size = GENERATE(0u, 1u, 4095u, 4096u, 4097u, 9'000'000u);
  std::string text(size, 'x');
  for (std::size_t i = 0; i < size; ++i) text[i] = static_cast<char>('a' + i * i % 23);
  Folder::write(folder / "f", text);
  InputFile file(folder / "f");
  CHECK(file.head() == text.substr(0, 4096));
  CHECK((file.read().view() == text));
}

TEST_CASE("InputFile: what is no file is refused with its kind", "[base][error]") {
  const Folder folder;
  REQUIRE(::mkfifo((folder / "fifo").c_str(), 0600) == 0);
  CHECK_THROWS_WITH(InputFile(folder / "fifo"), Catch::Contains("fifo: is a named pipe"));
  CHECK_THROWS_WITH(InputFile(folder / "model"), Catch::Contains("is a folder"));
  CHECK_THROWS_WITH(InputFile("/dev/zero"), "/dev/zero: is a device, not a file");
  CHECK_THROWS_WITH(InputFile(folder / "absent.xml"), Catch::Contains("No such file"));
  CHECK(code_of(folder / "fifo") == ErrorCode::NoInput);
  CHECK(code_of(folder / "absent.xml") == ErrorCode::NoInput);
}

TEST_CASE("InputFile: a pipe is read to its end", "[base]") {
  int ends[2];
  REQUIRE(::pipe(ends) == 0);
  const std::string text(9'000'000, 'p');
  std::thread writer([&] {
    for (std::size_t sent = 0; sent < text.size();) {
      const ssize_t put = ::write(ends[1], text.data() + sent, text.size() - sent);
      if (put <= 0) break;
      sent += static_cast<std::size_t>(put);
    }
    ::close(ends[1]);
  });
  InputFile file("/dev/fd/" + std::to_string(ends[0]));
  CHECK(file.head().substr(0, 2) == "pp");
  const FileBytes bytes = file.read();
  writer.join();
  ::close(ends[0]);
  CHECK((bytes.view() == text));
}

TEST_CASE("InputFile: the holes of a sparse file take no memory and read as zero bytes", "[base]") {
  const Folder folder;
  Folder::write(folder / "sparse", "head");
  fs::resize_file(folder / "sparse", std::uintmax_t{3} << 30);
  InputFile file(folder / "sparse");
  const FileBytes bytes = file.read();
  CHECK(bytes.view().size() == std::size_t{3} << 30);
  CHECK(bytes.view().substr(0, 4) == "head");
  CHECK(bytes.view()[(std::size_t{2} << 30) + 7] == '\0');
}

TEST_CASE("InputFile: a file cut after it was opened gives what is left", "[base]") {
  const Folder folder;
  Folder::write(folder / "f", std::string(100'000, 'x'));
  InputFile file(folder / "f");
  fs::resize_file(folder / "f", 50'000);
  CHECK(file.read().view().size() == 50'000);
}

TEST_CASE("InputFolder: files beneath the folder are opened, by links too", "[base]") {
  const Folder folder;
  fs::create_symlink("in.xml", folder / "model/link.xml");
  const InputFolder model(folder / "model");
  CHECK(model.open("in.xml")->head() == "content");
  CHECK(model.open("parts/deep.xml")->head() == "deep");
  CHECK(model.open("link.xml")->head() == "content");
  CHECK(model.open("link.xml")->identity() == model.open("in.xml")->identity());
}

TEST_CASE("InputFolder: names that lead elsewhere are refused before anything is opened", "[base][error]") {
  const Folder folder;
  const InputFolder model(folder / "model");
  const std::string name = GENERATE("", ".", "..", "../outside.xml", "parts/../in.xml", "/etc/passwd",
                                    "http://x/y.xml", "file:in.xml", "C:in.xml", "..\\outside.xml",
                                    "\\\\host\\x", "in\x01.xml", "parts//deep.xml", "./in.xml", "parts/");
  CHECK_THROWS_WITH(model.open(name), Catch::Contains("refused"));
}

TEST_CASE("InputFolder: links out of the folder, folders and pipes are refused", "[base][error]") {
  const Folder folder;
  fs::create_symlink("../outside.xml", folder / "model/out.xml");
  fs::create_symlink("/etc/passwd", folder / "model/absolute.xml");
  fs::create_symlink("/proc/self/root/etc/passwd", folder / "model/magic.xml");
  fs::create_symlink("loop.xml", folder / "model/loop.xml");
  REQUIRE(::mkfifo((folder / "model/fifo.xml").c_str(), 0600) == 0);
  const InputFolder model(folder / "model");
  CHECK_THROWS_WITH(model.open("out.xml"), Catch::Contains("leads out of the folder"));
  CHECK_THROWS_WITH(model.open("absolute.xml"), Catch::Contains("leads out of the folder"));
  CHECK_THROWS_AS(model.open("magic.xml"), Error);
  CHECK_THROWS_AS(model.open("loop.xml"), Error);
  CHECK_THROWS_WITH(model.open("fifo.xml"), Catch::Contains("is a named pipe"));
  CHECK_THROWS_WITH(model.open("parts"), Catch::Contains("is a folder"));
  CHECK_FALSE(model.open("absent.xml"));
  CHECK_THROWS_AS(InputFolder(folder / "nowhere"), Error);
}
