#include "worker_pool.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstring>
#include <optional>
#include <vector>

#include "meshcontour/error.hpp"

namespace meshcontour::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kCheckMilliseconds = 20;
constexpr std::chrono::seconds kGrace(2);  // between SIGTERM, which removes temporaries, and SIGKILL

bool read_whole(int descriptor, void* data, std::size_t size) {
  auto* to = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t got = read(descriptor, to, size);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    to += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

bool write_whole(int descriptor, const void* data, std::size_t size) {
  const auto* from = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t put = write(descriptor, from, size);
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) return false;
    from += put;
    size -= static_cast<std::size_t>(put);
  }
  return true;
}

// Resident memory of a process, 0 when it has just ended.
std::uint64_t resident_bytes(pid_t process) {
  const std::string path = "/proc/" + std::to_string(process) + "/statm";
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  std::array<char, 128> text{};
  const ssize_t size = read(file, text.data(), text.size() - 1);
  close(file);
  const char* resident = size > 0 ? std::strchr(text.data(), ' ') : nullptr;
  if (resident == nullptr) return 0;
  std::uint64_t pages = 0;
  std::from_chars(resident + 1, text.data() + size, pages);
  return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

[[noreturn]] void serve(int channel, const std::function<std::string(std::size_t)>& task) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  std::size_t number = 0;
  while (read_whole(channel, &number, sizeof number)) {
    const std::string payload = task(number);
    const std::size_t size = payload.size();
    if (!write_whole(channel, &size, sizeof size) || !write_whole(channel, payload.data(), size)) break;
  }
  _exit(0);
}

struct Worker {
  pid_t process = 0;
  int channel = -1;
  std::optional<std::size_t> task;
  Clock::time_point started;
  TaskResult::End reason = TaskResult::End::Crashed;  // why it was told to end
  std::optional<Clock::time_point> kill_at;           // set once it was told to end
};

class Pool {
 public:
  Pool(std::size_t count, const WorkerLimits& limits, const std::function<std::string(std::size_t)>& task,
       const std::function<void(std::size_t, const TaskResult&)>& finished)
      : count_(count), limits_(limits), task_(task), finished_(finished) {}

  ~Pool() {
    for (Worker& worker : workers_) end(worker);
  }

  void run() {
    workers_.resize(std::min<std::size_t>(std::max(limits_.workers, 1u), count_));
    for (Worker& worker : workers_) start(worker);
    while (done_ < count_) {
      wait_for_results();
      for (Worker& worker : workers_) check_limits(worker);
    }
  }

 private:
  void start(Worker& worker) {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
      throw Error(ErrorCode::OutOfMemory, std::string("no channel to a worker: ") + std::strerror(errno));
    }
    const pid_t process = fork();
    if (process < 0)
      throw Error(ErrorCode::OutOfMemory, std::string("no worker process: ") + std::strerror(errno));
    if (process == 0) {
      close(ends[0]);
      for (const Worker& other : workers_) {
        if (other.channel >= 0) close(other.channel);
      }
      serve(ends[1], task_);
    }
    close(ends[1]);
    worker = Worker{};
    worker.process = process;
    worker.channel = ends[0];
    give_next(worker);
  }

  void give_next(Worker& worker) {
    if (next_ == count_) return;
    worker.task = next_++;
    worker.started = Clock::now();
    // A worker that is gone already is noticed when its channel is read.
    (void)write_whole(worker.channel, &*worker.task, sizeof *worker.task);
  }

  void wait_for_results() {
    std::vector<pollfd> channels;
    for (const Worker& worker : workers_) channels.push_back({worker.channel, POLLIN, 0});
    const bool limited = limits_.seconds > 0 || limits_.memory > 0;
    const int ready = poll(channels.data(), channels.size(), limited ? kCheckMilliseconds : -1);
    if (ready <= 0) return;
    for (std::size_t i = 0; i < workers_.size(); ++i) {
      if (channels[i].revents != 0) receive(workers_[i]);
    }
  }

  void receive(Worker& worker) {
    TaskResult result;
    std::size_t size = 0;
    bool whole = read_whole(worker.channel, &size, sizeof size);
    if (whole) {
      result.payload.resize(size);
      whole = read_whole(worker.channel, result.payload.data(), size);
    }
    if (whole) {
      finish(worker, result);
      give_next(worker);
      return;
    }
    const int status = end(worker);
    result = {worker.reason, WIFSIGNALED(status) ? WTERMSIG(status) : 0, {}};
    if (worker.task) finish(worker, result);
    if (done_ < count_ && next_ < count_) start(worker);
  }

  void finish(Worker& worker, const TaskResult& result) {
    const std::size_t task = *worker.task;
    worker.task.reset();
    ++done_;
    finished_(task, result);
  }

  void check_limits(Worker& worker) {
    if (!worker.task) return;
    const Clock::time_point now = Clock::now();
    if (worker.kill_at) {
      if (now > *worker.kill_at) kill(worker.process, SIGKILL);
      return;
    }
    const double seconds = std::chrono::duration<double>(now - worker.started).count();
    const bool too_long = limits_.seconds > 0 && seconds > limits_.seconds;
    const bool too_large = limits_.memory > 0 && resident_bytes(worker.process) > limits_.memory;
    if (!too_long && !too_large) return;
    worker.reason = too_long ? TaskResult::End::TimedOut : TaskResult::End::TooLarge;
    worker.kill_at = now + kGrace;
    kill(worker.process, SIGTERM);
  }

  // Closes the channel, which ends an idle worker, and collects its status.
  static int end(Worker& worker) {
    if (worker.process == 0) return 0;
    close(worker.channel);
    worker.channel = -1;
    int status = 0;
    while (waitpid(worker.process, &status, 0) < 0 && errno == EINTR) {
    }
    worker.process = 0;
    return status;
  }

  std::size_t count_;
  WorkerLimits limits_;
  const std::function<std::string(std::size_t)>& task_;
  const std::function<void(std::size_t, const TaskResult&)>& finished_;
  std::vector<Worker> workers_;
  std::size_t next_ = 0, done_ = 0;
};

}  // namespace

void run_in_workers(std::size_t count, const WorkerLimits& limits,
                    const std::function<std::string(std::size_t)>& task,
                    const std::function<void(std::size_t, const TaskResult&)>& finished) {
  Pool(count, limits, task, finished).run();
}

}  // namespace meshcontour::app
