# Cross-compiles everything for 64-bit ARM against HAGEN_SYSROOT, a folder with Debian's packages for it, and runs the
# programs with QEMU, for their manual pages. See scripts/package --arch arm64.
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES HAGEN_SYSROOT)
set(CMAKE_SYSROOT ${HAGEN_SYSROOT})
include(${CMAKE_CURRENT_LIST_DIR}/arm64.cmake)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64 -L ${HAGEN_SYSROOT})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${HAGEN_SYSROOT})
set(ENV{PKG_CONFIG_LIBDIR} ${HAGEN_SYSROOT}/usr/lib/aarch64-linux-gnu/pkgconfig:${HAGEN_SYSROOT}/usr/share/pkgconfig)
