// What Debian's libraries for WebAssembly lack. The module itself is what the linker is told to export: the C
// interface.

// The one thread never ends, so what it keeps is never destroyed.
extern "C" int __cxa_thread_atexit(void (*destroy)(void*), void* object, void* library);
extern "C" int __cxa_thread_atexit(void (*)(void*), void*, void*) {
    return 0;
}
