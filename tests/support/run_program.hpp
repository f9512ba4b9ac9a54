#pragma once

// Runs the meshcontour program as a user does and collects what it prints.

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <string>
#include <vector>

#include "support/paths.hpp"
#include "support/temporary_folder.hpp"

struct ProgramResult {
  int code = 0;  ///< exit code, or 128 + signal
  std::string output, errors;
};

struct ProgramOptions {
  std::string folder = {};                    ///< working folder; empty: this one
  std::string input = "/dev/null";            ///< standard input
  std::vector<std::string> environment = {};  ///< NAME=value; empty: this process's own
  std::string output = {};                    ///< file for standard output; empty: collected
};

inline std::size_t count_lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

inline ProgramResult run_program(const std::vector<std::string>& arguments,
                                 const ProgramOptions& options = {}) {
  const TemporaryFolder folder;
  const std::string output = options.output.empty() ? (folder / "output").string() : options.output;
  const std::string errors = (folder / "errors").string();
  std::vector<std::string> words = {MESHCONTOUR_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const auto pointers = [](const std::vector<std::string>& list) {
    std::vector<char*> out;
    for (const std::string& word : list) out.push_back(const_cast<char*>(word.c_str()));
    out.push_back(nullptr);
    return out;
  };
  const std::vector<char*> argv = pointers(words), envp = pointers(options.environment);
  const pid_t child = fork();
  if (child == 0) {
    const auto redirect = [](const std::string& path, int flags, int descriptor) {
      const int file = open(path.c_str(), flags, 0600);
      if (file < 0 || dup2(file, descriptor) < 0) _exit(126);
      close(file);
    };
    redirect(options.input, O_RDONLY, STDIN_FILENO);
    redirect(output, O_WRONLY | O_CREAT, STDOUT_FILENO);
    redirect(errors, O_WRONLY | O_CREAT, STDERR_FILENO);
    if (!options.folder.empty() && chdir(options.folder.c_str()) != 0) _exit(126);
    if (options.environment.empty()) {
      execv(argv[0], argv.data());
    } else {
      execve(argv[0], argv.data(), envp.data());
    }
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ProgramResult result;
  result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (options.output.empty()) result.output = file_text(output);
  result.errors = file_text(errors);
  return result;
}
