// What Debian's libraries for WebAssembly lack. The module itself is what the linker is told to export: the C
// interface.

#include <__verbose_abort>

// The one thread never ends, so what it keeps is never destroyed.
extern "C" int __cxa_thread_atexit(void (*destroy)(void*), void* object, void* library);
extern "C" int __cxa_thread_atexit(void (*)(void*), void*, void*) {
    return 0;
}

// The standard library's last words; a trap says as much to a page.
extern "C" [[noreturn]] void abort_message(const char* format, ...);
extern "C" [[noreturn]] void abort_message(const char*, ...) {
    __builtin_trap();
}
void std::__libcpp_verbose_abort(const char*, ...) {
    __builtin_trap();
}
