// Programmer errors (a stale id, a negative dt): a failed assertion calls a handler that a host or a test may replace.
#pragma once

#include "elastoon/export.h"

namespace elastoon ELASTOON_API {

/// Gets the failed condition, what it means, and where it stands. It may return: the call then does nothing, where it
/// can.
using AssertHandler = void (*)(const char* condition, const char* message, const char* file, int line);

/// Sets the handler and gives back the one before. The default prints and, in builds without NDEBUG, aborts. Null:
/// default.
AssertHandler setAssertHandler(AssertHandler handler);

void assertionFailed(const char* condition, const char* message, const char* file, int line);

} // namespace elastoon ELASTOON_API

#define ELASTOON_ASSERT(condition, message)                                                                            \
    ((condition) ? void() : ::elastoon::assertionFailed(#condition, message, __FILE__, __LINE__))
