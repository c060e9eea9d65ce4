// A mutex, and nothing where the platform has no threads (WebAssembly without its threads).
#pragma once

#if defined(__wasi__) && !defined(_REENTRANT)

namespace elastoon {

struct Mutex {
    void lock() {}
    void unlock() {}
};

} // namespace elastoon

#else

#include <mutex>

namespace elastoon {

using Mutex = std::mutex;

} // namespace elastoon

#endif

namespace elastoon {

/// Holds a mutex as long as it lives.
class Lock {
public:
    explicit Lock(Mutex& mutex) : mutex_(mutex) { mutex_.lock(); }
    ~Lock() { mutex_.unlock(); }
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;

private:
    Mutex& mutex_;
};

} // namespace elastoon
