#include <fcntl.h>
#include <sys/mount.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

#include "meshcontour/output.hpp"
#include "support/catch.hpp"
#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

using namespace meshcontour;
namespace fs = std::filesystem;

namespace {

using Names = std::set<std::string>;

// Replaces a (which exists) and b (which does not), with named temporaries if asked.
int replace_pair(const TemporaryFolder& folder, bool anonymous, const std::function<void()>& before_commit) {
  prepare_process();
  if (!anonymous && !fail_system_call(SYS_openat, EOPNOTSUPP, 2, O_TMPFILE & ~O_DIRECTORY)) return 99;
  OutputSet set;
  set.open(folder / "a").write("new a");
  set.open(folder / "b").write("new b");
  before_commit();
  set.commit();
  return 0;
}

bool unchanged(const TemporaryFolder& folder) {
  return folder.names() == Names{"a"} && file_text(folder / "a") == "old";
}

}  // namespace

TEST_CASE("OutputSet: works where the file system has no anonymous files", "[base][output]") {
  const TemporaryFolder folder;
  write_file(folder / "a", "old");
  CHECK(in_child([&] { return replace_pair(folder, false, [] {}); }) == 0);
  CHECK(folder.names() == Names{"a", "b"});
  CHECK(file_text(folder / "a") == "new a");
}

TEST_CASE("OutputSet: whatever system call fails, the old files stay whole and nothing is left",
          "[base][output][error]") {
  const bool anonymous = GENERATE(true, false);
  const int call = GENERATE(SYS_write, SYS_fsync, SYS_linkat, SYS_renameat);
  const int error = GENERATE(EIO, ENOSPC, EACCES);
  CAPTURE(anonymous, call, error);
  if (call == SYS_linkat && !anonymous) return;
  const TemporaryFolder folder;
  write_file(folder / "a", "old");
  const int code = in_child([&] {
    return replace_pair(folder, anonymous, [&] {
      if (!fail_system_call(call, error)) _exit(99);
      if (call == SYS_renameat && !fail_system_call(SYS_renameat2, error)) _exit(99);
    });
  });
  CHECK(code == 74);
  CHECK(unchanged(folder));
}

TEST_CASE("OutputSet: when the second rename fails the first is undone", "[base][output][error]") {
  const bool anonymous = GENERATE(true, false);
  const TemporaryFolder folder;
  write_file(folder / "a", "old");
  const int code = in_child(
      [&] { return replace_pair(folder, anonymous, [&] { fs::create_directories(folder / "b/full"); }); });
  CHECK(code == 74);
  CHECK(folder.names() == Names{"a", "b"});
  CHECK(file_text(folder / "a") == "old");
  CHECK(fs::is_directory(folder / "b"));
}

TEST_CASE("OutputSet: a full disk is an error of the write", "[base][output][error]") {
  const TemporaryFolder folder;
  if (mount("none", folder.path().c_str(), "tmpfs", 0, "size=256k") != 0) return;  // only root may
  write_file(folder / "a", "old");
  const int code = in_child([&] {
    OutputSet set;
    set.open(folder / "a").write(std::string(1 << 20, 'x'));
    set.commit();
    return 0;
  });
  const bool kept = unchanged(folder);
  umount(folder.path().c_str());
  CHECK(code == 74);
  CHECK(kept);
}

TEST_CASE("OutputSet: a signal ends the process and removes the temporaries", "[base][output]") {
  const int number = GENERATE(SIGINT, SIGTERM, SIGHUP, SIGKILL);
  const bool anonymous = GENERATE(true, false);
  if (number == SIGKILL && !anonymous) return;  // nobody could
  const TemporaryFolder folder;
  write_file(folder / "a", "old");
  int ready[2] = {};
  REQUIRE(pipe(ready) == 0);
  const pid_t child = start_child([&] {
    return replace_pair(folder, anonymous, [&] {
      [[maybe_unused]] const ssize_t count = write(ready[1], "x", 1);
      for (;;) pause();
    });
  });
  char byte = 0;
  REQUIRE(read(ready[0], &byte, 1) == 1);
  CHECK(folder.names().size() == (anonymous ? 1 : 3));
  kill(child, number);
  CHECK(wait_for(child) == 128 + number);
  CHECK(unchanged(folder));
  close(ready[0]);
  close(ready[1]);
}

TEST_CASE("OutputSet: a signal that is ignored stays ignored", "[base][output]") {
  const TemporaryFolder folder;
  const int code = in_child([&] {
    std::signal(SIGHUP, SIG_IGN);
    return replace_pair(folder, true, [] { raise(SIGHUP); });
  });
  CHECK(code == 0);
  CHECK(folder.names() == Names{"a", "b"});
}

TEST_CASE("OutputSet: killed at any moment, each file is old or complete", "[base][output]") {
  const TemporaryFolder folder;
  for (useconds_t delay = 0; delay < 2000; delay += 50) {
    const int number = delay % 100 == 0 ? SIGTERM : SIGKILL;
    write_file(folder / "a", "old");
    const pid_t child = start_child([&] {
      prepare_process();
      for (;;) {
        OutputSet set;
        set.open(folder / "a").write(std::string(300'000, 'x'));
        set.commit();
      }
      return 0;
    });
    usleep(delay);
    kill(child, number);
    const int code = wait_for(child);
    CHECK(code == 128 + number);
    const std::string text = file_text(folder / "a");
    CHECK((text == "old" || text == std::string(300'000, 'x')));
    if (number == SIGTERM) CHECK(folder.names() == Names{"a"});
    for (const std::string& name : folder.names()) fs::remove(folder / name);
  }
}
