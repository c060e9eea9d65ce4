# What the WebAssembly modules share: the same pass of wasm-opt on every machine. Left alone, clang runs one where it finds
# the program and none where it does not, and the module's size goes by what is installed.
find_program(WASM_OPT wasm-opt REQUIRED)

function(shrink_wasm_module target)
  # -O0 to the linker keeps clang from a pass of its own (its --no-wasm-opt links nothing in version 19). Nothing lies below
  # the first address of data, so small offsets may go into the loads and stores.
  target_link_options(${target} PRIVATE -O0 -Wl,--global-base=1024)
  add_custom_command(TARGET ${target} POST_BUILD COMMAND ${WASM_OPT} $<TARGET_FILE:${target}> -O3 --low-memory-unused
    --flexible-inline-max-function-size=10 -o $<TARGET_FILE:${target}> VERBATIM)
endfunction()
