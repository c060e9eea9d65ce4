# clang 19 for WebAssembly with Debian's wasi-libc and libc++. No exceptions, no threads; 128-bit SIMD.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_C_COMPILER clang-19)
set(CMAKE_CXX_COMPILER clang++-19)
set(CMAKE_AR llvm-ar-19)
set(CMAKE_RANLIB llvm-ranlib-19)
set(CMAKE_C_COMPILER_TARGET wasm32-wasi)
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_CXX_FLAGS_INIT "-msimd128 -mbulk-memory -mnontrapping-fptoint -fno-exceptions -fno-rtti")

# glm and nlohmann-json are headers in /usr/include, which is the machine's own and must not be looked into. So they are
# found through a folder of links.
set(links ${CMAKE_BINARY_DIR}/headers)
if(NOT EXISTS ${links})
  file(MAKE_DIRECTORY ${links})
  foreach(name glm nlohmann)
    file(CREATE_LINK /usr/include/${name} ${links}/${name} SYMBOLIC)
  endforeach()
endif()
set(ELASTOON_HEADERS ${links})
