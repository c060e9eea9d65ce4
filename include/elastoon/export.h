/* What a shared library shows of itself: everything else is hidden. */
#ifndef ELASTOON_EXPORT_H
#define ELASTOON_EXPORT_H

#define ELASTOON_API __attribute__((visibility("default")))

#endif
