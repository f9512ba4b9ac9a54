#pragma once

// Runs a function in a forked process, for what cannot be undone: signals, limits, failing system calls.

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstddef>
#include <functional>
#include <stdexcept>

#include "meshcontour/error.hpp"

/// Starts the function in a child; it ends with the function's value, with an Error's code, or with 99.
inline pid_t start_child(const std::function<int()>& body) {
  // No signal before the child has dropped the handlers of the test framework, which would take locks of the
  // parent.
  sigset_t all, before;
  sigfillset(&all);
  sigprocmask(SIG_SETMASK, &all, &before);
  const pid_t child = fork();
  if (child == 0) {
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGABRT, SIGSEGV}) std::signal(number, SIG_DFL);
  }
  sigprocmask(SIG_SETMASK, &before, nullptr);
  if (child < 0) throw std::runtime_error("no child process");
  if (child > 0) return child;
  try {
    _exit(body());
  } catch (const meshcontour::Error& error) {
    _exit(static_cast<int>(error.code()));
  } catch (...) {
    _exit(99);
  }
}

/// Exit code, or 128 + signal.
inline int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

inline int in_child(const std::function<int()>& body) {
  return wait_for(start_child(body));
}

/// Makes a system call fail from now on, in this process; with a mask only where an argument has one of its
/// bits. False where the kernel does not let us.
inline bool fail_system_call(int number, int error, unsigned argument = 0, unsigned mask = 0) {
  const auto offset = [](std::size_t bytes) { return static_cast<unsigned>(bytes); };
  const unsigned refusal = SECCOMP_RET_ERRNO | (static_cast<unsigned>(error) & SECCOMP_RET_DATA);
  std::array<sock_filter, 6> filter = {{
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offset(offsetof(seccomp_data, nr))),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned>(number), 0, 3),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offset(offsetof(seccomp_data, args)) + 8 * argument),
      BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, mask, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, refusal),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  }};
  if (mask == 0) filter[3] = BPF_STMT(BPF_RET | BPF_K, refusal);
  const sock_fprog program = {static_cast<unsigned short>(filter.size()), filter.data()};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}
