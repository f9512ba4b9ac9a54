#include "base/temporaries.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>

#include "meshcontour/output.hpp"

namespace meshcontour {
namespace detail {

// Slots are linked once and never freed, only used again: a signal handler may walk the list at any moment.
struct TemporarySlot {
  enum State { Free, Claimed, Live };

  std::atomic<int> state = Claimed;
  pid_t owner = 0;  // a forked child must not remove what its parent is writing
  int folder = -1;
  std::array<char, 48> name = {};
  TemporarySlot* next = nullptr;
};

namespace {

std::atomic<TemporarySlot*> first_slot = nullptr;
std::atomic<bool> process_is_ending = false;
std::atomic<int> holders = 0;
std::atomic<int> held_signal = 0;

static_assert(std::atomic<int>::is_always_lock_free && std::atomic<TemporarySlot*>::is_always_lock_free);

TemporarySlot* claim_slot() {
  for (TemporarySlot* slot = first_slot.load(); slot != nullptr; slot = slot->next) {
    int expected = TemporarySlot::Free;
    if (slot->state.compare_exchange_strong(expected, TemporarySlot::Claimed)) return slot;
  }
  auto* slot = new TemporarySlot;
  slot->next = first_slot.load();
  while (!first_slot.compare_exchange_weak(slot->next, slot)) {
  }
  return slot;
}

std::uint64_t unpredictable_number() {
  std::uint64_t number = 0;
  while (getrandom(&number, sizeof number, 0) != static_cast<ssize_t>(sizeof number)) {
    if (errno != EINTR) throw Error(ErrorCode::Internal, "the system gives no random numbers");
  }
  return number;
}

}  // namespace

Temporary::Temporary(int folder) {
  const std::uint64_t number = unpredictable_number();
  slot_ = claim_slot();
  slot_->owner = getpid();
  slot_->folder = folder;
  *fmt::format_to(slot_->name.data(), ".meshcontour-{:016x}.tmp", number) = '\0';
  slot_->state.store(TemporarySlot::Live);
}

Temporary::~Temporary() {
  unlinkat(slot_->folder, slot_->name.data(), 0);
  slot_->state.store(TemporarySlot::Free);
}

const char* Temporary::name() const {
  return slot_->name.data();
}

void Temporary::created() const {
  if (!process_is_ending.load()) return;
  unlinkat(slot_->folder, slot_->name.data(), 0);
  for (;;) pause();
}

SignalsHeld::SignalsHeld() {
  holders.fetch_add(1);
}

SignalsHeld::~SignalsHeld() {
  if (holders.fetch_sub(1) > 1) return;
  if (const int number = held_signal.exchange(0); number != 0) raise(number);
}

}  // namespace detail

namespace {

// Ends the process as the signal would have, for the sake of whoever waits for it.
void end_by_signal(int number) {
  if (detail::holders.load() > 0) {
    detail::held_signal.store(number);
    return;
  }
  detail::process_is_ending.store(true);
  remove_temporaries();
  std::signal(number, SIG_DFL);
  raise(number);
}

void handle_ending_signals() {
  struct sigaction action = {};
  action.sa_handler = end_by_signal;
  sigemptyset(&action.sa_mask);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&action.sa_mask, number);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before = {};
    if (sigaction(number, nullptr, &before) == 0 && before.sa_handler != SIG_IGN) {
      sigaction(number, &action, nullptr);
    }
  }
}

}  // namespace

void remove_temporaries() noexcept {
  const int saved = errno;
  const pid_t self = getpid();
  for (auto* slot = detail::first_slot.load(); slot != nullptr; slot = slot->next) {
    if (slot->state.load() == detail::TemporarySlot::Live && slot->owner == self) {
      unlinkat(slot->folder, slot->name.data(), 0);
    }
  }
  errno = saved;
}

void prepare_process() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    // Opened the wrong way round: the lowest free descriptor is this one, and using it fails.
    if (fcntl(descriptor, F_GETFD) < 0) open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  handle_ending_signals();
}

}  // namespace meshcontour
