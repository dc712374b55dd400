# Cross compiling for Debian 12 on arm64, with the libraries that make-sysroot has unpacked; what is
# built runs here in QEMU's user mode.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
cmake_path(SET SPARSIGHT_SYSROOT NORMALIZE ${CMAKE_CURRENT_LIST_DIR}/../../build/arm64-sysroot)
if(NOT EXISTS ${SPARSIGHT_SYSROOT}/made-of)
  message(FATAL_ERROR "The arm64 libraries are not there: run toolchain/arm64/make-sysroot build/arm64-sysroot")
endif()

set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_SYSROOT ${SPARSIGHT_SYSROOT})
# Libraries that only other libraries need are not searched for in a foreign system's folders.
set(CMAKE_EXE_LINKER_FLAGS_INIT -Wl,-rpath-link,${SPARSIGHT_SYSROOT}/usr/lib/aarch64-linux-gnu)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64-static -L ${SPARSIGHT_SYSROOT})

set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)  # programs run here, all else is of the target
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
