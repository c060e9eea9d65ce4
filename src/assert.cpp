// See assert.h.
#include "elastoon/assert.h"

#include "elastoon/result.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace elastoon {

namespace {

void printAndAbort(const char* condition, const char* message, const char* file, int line) {
    const std::string text =
        std::string("elastoon: ") + message + " (" + condition + ", at " + file + ":" + std::to_string(line) + ")\n";
    std::fputs(text.c_str(), stderr);
#ifndef NDEBUG
    std::abort();
#endif
}

std::atomic<AssertHandler> current_handler{printAndAbort};

} // namespace

AssertHandler setAssertHandler(AssertHandler handler) {
    return current_handler.exchange(handler != nullptr ? handler : printAndAbort);
}

void assertionFailed(const char* condition, const char* message, const char* file, int line) {
    current_handler.load()(condition, message, file, line);
}

void resultWithoutValue(const Error& error) {
    assertionFailed("result.ok()", error.text().c_str(), __FILE__, __LINE__);
    std::abort();
}

} // namespace elastoon
