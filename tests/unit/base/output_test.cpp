#include "meshcontour/output.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>

#include "support/catch.hpp"
#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

using namespace meshcontour;
namespace fs = std::filesystem;

namespace {

using Names = std::set<std::string>;

void write_pair(const TemporaryFolder& folder, std::size_t bytes) {
  OutputSet set;
  Sink& a = set.open(folder / "a");
  Sink& b = set.open(folder / "b");
  a.write(std::string(bytes, 'A'));
  b.write(std::string(bytes, 'B'));
  set.commit();
}

// The exit code of a run in a child that writes `target`, without a trace of it on success.
int code_of_writing(const fs::path& target, std::size_t bytes) {
  return in_child([&] {
    prepare_process();
    OutputSet set;
    set.open(target).write(std::string(bytes, 'x'));
    set.commit();
    return 0;
  });
}

}  // namespace

TEST_CASE("OutputSet: nothing shows before commit, everything after", "[base][output]") {
  const TemporaryFolder folder;
  write_file(folder / "a", "old");
  OutputSet set;
  set.open(folder / "a").write("new");
  Sink& b = set.open(folder / "b");
  for (int i = 0; i < 1000; ++i) b.write(std::string(1000, static_cast<char>('a' + i % 26)));
  CHECK(file_text(folder / "a") == "old");
  CHECK_FALSE(fs::exists(folder / "b"));
  set.commit();
  CHECK(folder.names() == Names{"a", "b"});
  CHECK(file_text(folder / "a") == "new");
  CHECK(file_text(folder / "b").size() == 1'000'000);
  CHECK(file_text(folder / "b").substr(999, 2) == "ab");
}

TEST_CASE("OutputSet: without commit the old file stays and nothing is left", "[base][output]") {
  const TemporaryFolder folder;
  write_file(folder / "a", "old");
  {
    OutputSet set;
    set.open(folder / "a").write("new");
    set.open(folder / "b").write(std::string(1 << 20, 'x'));
  }
  CHECK(folder.names() == Names{"a"});
  CHECK(file_text(folder / "a") == "old");
}

TEST_CASE("OutputSet: a file keeps its permissions, a new one follows the umask", "[base][output]") {
  const TemporaryFolder folder;
  write_file(folder / "a", "old");
  fs::permissions(folder / "a", fs::perms(0640));
  const mode_t mask = umask(027);
  write_pair(folder, 10);
  umask(mask);
  CHECK(fs::status(folder / "a").permissions() == fs::perms(0640));
  CHECK(fs::status(folder / "b").permissions() == fs::perms(0640));
}

TEST_CASE("OutputSet: links are followed, also to a file that does not exist yet", "[base][output]") {
  const TemporaryFolder folder;
  fs::create_directory(folder / "there");
  write_file(folder / "there/a", "old");
  fs::create_symlink("there/a", folder / "a");
  fs::create_symlink("there/b", folder / "b");
  write_pair(folder, 3);
  CHECK(fs::is_symlink(folder / "a"));
  CHECK(file_text(folder / "there/a") == "AAA");
  CHECK(file_text(folder / "there/b") == "BBB");
}

TEST_CASE("OutputSet: a target that cannot be created is refused at once, with the reason",
          "[base][output][error]") {
  const TemporaryFolder folder;
  write_file(folder / "file", "");
  fs::create_symlink("loop", folder / "loop");
  const auto refusal = [](const fs::path& target) {
    try {
      OutputSet().open(target);
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::CannotCreate);
      return std::string(error.what());
    }
    return std::string("no error");
  };
  using Catch::EndsWith;
  CHECK_THAT(refusal(folder.path()), EndsWith("cannot create: Is a directory"));
  CHECK_THAT(refusal(folder / "name/"), EndsWith("cannot create: Is a directory"));
  CHECK_THAT(refusal(folder / "absent/name"), EndsWith("cannot open its folder: No such file or directory"));
  CHECK_THAT(refusal(folder / "file/name"), EndsWith("cannot open its folder: Not a directory"));
  CHECK_THAT(refusal(folder / "loop"), EndsWith("Too many levels of symbolic links"));
  CHECK_THAT(refusal(folder / std::string(300, 'n')), EndsWith("File name too long"));
  CHECK_THAT(refusal(""), EndsWith("No such file or directory"));
  CHECK_THAT(refusal("/dev/fd/999"), EndsWith("Bad file descriptor"));
  CHECK(folder.names() == Names{"file", "loop"});
}

TEST_CASE("OutputSet: one target named twice is refused", "[base][output][error]") {
  const TemporaryFolder folder;
  OutputSet set;
  set.open(folder / "a");
  set.open(folder / "b");
  CHECK_THROWS_WITH(set.open(folder.path() / "." / "a"), Catch::EndsWith("named twice as an output"));
}

TEST_CASE("OutputSet: a read-only folder or file is refused", "[base][output][error]") {
  const TemporaryFolder folder;
  write_file(folder / "a", "old");
  fs::permissions(folder / "a", fs::perms(0444));
  const fs::perms access = GENERATE(fs::perms(0555), fs::perms(0777));
  fs::permissions(folder.path(), access);
  const auto as_nobody = [&](const std::string& name) {
    return in_child([&] {
      if (geteuid() == 0 && setuid(65534) != 0) return 99;
      OutputSet().open(folder / name);
      return 0;
    });
  };
  CHECK(as_nobody("a") == 73);
  CHECK(as_nobody("b") == (access == fs::perms(0555) ? 73 : 0));
  CHECK(folder.names() == Names{"a"});
}

TEST_CASE("OutputSet: special files are written in place", "[base][output]") {
  const TemporaryFolder folder;
  SECTION("a full device is an error of the write") {
    CHECK(code_of_writing("/dev/full", 10) == 74);
    CHECK(code_of_writing("/dev/null", 1 << 20) == 0);
    CHECK(fs::is_character_file("/dev/null"));
  }
  SECTION("a pipe with a name") {
    const fs::path pipe = folder / "pipe";
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    const pid_t writer = start_child([&] { return code_of_writing(pipe, 1 << 20); });
    CHECK(file_text(pipe).size() == 1 << 20);
    CHECK(wait_for(writer) == 0);
    CHECK(fs::is_fifo(pipe));
  }
  SECTION("standard output, by any of its names, goes on where it is") {
    const std::string name = GENERATE("-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1");
    const int code = in_child([&] {
      dup2(open((folder / "out").c_str(), O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
      if (write(STDOUT_FILENO, "before ", 7) != 7) return 99;
      return code_of_writing(name, 3);
    });
    CHECK(code == 0);
    CHECK(file_text(folder / "out") == "before xxx");
  }
}

TEST_CASE("OutputSet: closed ends of standard output are errors, not signals", "[base][output][error]") {
  SECTION("a pipe that nobody reads") {
    int ends[2] = {};
    REQUIRE(pipe(ends) == 0);
    close(ends[0]);
    CHECK(in_child([&] {
            dup2(ends[1], STDOUT_FILENO);
            return code_of_writing("-", 10);
          }) == 74);
    close(ends[1]);
  }
  SECTION("a descriptor that is closed is not taken by a file") {
    CHECK(in_child([&] {
            close(STDOUT_FILENO);
            return code_of_writing("-", 10);
          }) == 73);
  }
}

TEST_CASE("OutputSet: a file size limit is an error of the write and leaves nothing",
          "[base][output][error]") {
  const TemporaryFolder folder;
  write_file(folder / "a", "old");
  const int code = in_child([&] {
    prepare_process();
    const rlimit limit = {100'000, 100'000};
    setrlimit(RLIMIT_FSIZE, &limit);
    write_pair(folder, 1 << 20);
    return 0;
  });
  CHECK(code == 74);
  CHECK(folder.names() == Names{"a"});
  CHECK(file_text(folder / "a") == "old");
}
