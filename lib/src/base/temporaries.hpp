#pragma once

// Names of temporary files, kept where a signal handler can remove them.

namespace meshcontour::detail {

struct TemporarySlot;

/// An unpredictable file name in a folder, removed from there when this object ends, or when a signal ends
/// the process. It is registered before the file exists, so that there is no moment in which the file could
/// be left behind.
class Temporary {
 public:
  /// @param folder  descriptor of an open folder that outlives this object.
  explicit Temporary(int folder);
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  ~Temporary();

  const char* name() const;

  /// Call after the file has been created: a signal handler in another thread may have looked for it just
  /// before.
  void created() const;

 private:
  TemporarySlot* slot_;
};

/// While one exists, a signal that ends the process waits: renames of one set are not torn apart.
class SignalsHeld {
 public:
  SignalsHeld();
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;
  ~SignalsHeld();
};

}  // namespace meshcontour::detail
