// A progress bar on a terminal (nothing elsewhere), and the flag that Ctrl-C sets.
#pragma once

#include <chrono>
#include <string>

namespace elastoon {

/// Draws "label [#####.....]  42 %  12 s left" on standard error where that is a terminal. Ends its line when
/// destroyed.
class Progress {
public:
    Progress(std::string label, double total);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    /// `done` of the total. Cheap to call often.
    void at(double done);

private:
    std::string label_;
    double total_;
    bool shown_;
    std::chrono::steady_clock::time_point begun_, drawn_;
};

/// From now on Ctrl-C (SIGINT, SIGTERM) sets a flag instead of ending the program; a second one ends it.
void catchInterrupts();
/// Long work asks this often, and stops cleanly: temporary files go, finished ones stay.
[[nodiscard]] bool interrupted();

} // namespace elastoon
