# Debian's cross compiler for arm64, and its user-mode emulator to run what it makes. The compiler looks into
# /usr/include by itself, after its own C library: glm and nlohmann-json, which are headers, need nothing else.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64)
set(CMAKE_EXE_LINKER_FLAGS_INIT -static) # no arm64 libraries to be found at run time
