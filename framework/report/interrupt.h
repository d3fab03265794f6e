// Ctrl-C asks a run to end after the frame that is being rendered; a second one ends the program at once.
#pragma once

namespace dvrlab {

/// Installs the handler for its lifetime.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
};

/// True once Ctrl-C was pressed.
bool interrupted();

}  // namespace dvrlab
