# hagen_target(TARGET): settings shared by all targets of this project.
function(hagen_target target)
  target_compile_features(${target} PUBLIC cxx_std_17)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/libs)  # private headers
  target_compile_options(
    ${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                      $<$<BOOL:${HAGEN_WARNINGS_AS_ERRORS}>:-Werror>
                      # No implicit fused multiply-add, so that results are equal on every machine.
                      -ffp-contract=off
                      # No code reads floating-point exception flags. Without them, GCC vectorises
                      # loops with a condition per pixel; results do not change. Set for all
                      # targets, because GCC takes this option from the precompiled header.
                      -fno-trapping-math)
  # SIMD (Highway): one binary selects among these instruction sets at run time. The disabled sets
  # are not faster here, and each costs a compilation. (ARM's SVE vectors have no compile-time size
  # and cannot be stored in arrays.)
  set(left_out HWY_SSSE3 HWY_AVX3_DL HWY_SVE HWY_SVE2 HWY_SVE_256 HWY_SVE2_128)
  list(JOIN left_out "|" left_out)
  target_compile_definitions(${target} PRIVATE "HWY_DISABLED_TARGETS=(${left_out})")
  if(HAGEN_SANITIZE)
    target_compile_options(${target} PUBLIC -fsanitize=${HAGEN_SANITIZE} -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=${HAGEN_SANITIZE})
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")  # GCC would warn about std::optional and std::regex
      target_compile_options(${target} PUBLIC -Wno-maybe-uninitialized)
    endif()
  endif()
endfunction()

# hagen_hot(TARGET): aligns loops and functions to fetch blocks. Otherwise, unrelated changes in the
# library make small bit loops up to 15 % slower or faster.
function(hagen_hot target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD OFF)
  target_compile_options(${target} PRIVATE -falign-functions=64 -falign-loops=32 -falign-jumps=16)
endfunction()

# hagen_unity(TARGET SOURCE...): compiles sources in batches for faster builds, except those that
# Highway compiles once per instruction set.
option(HAGEN_UNITY_BUILD "Compile the libraries in batches of sources" ON)
function(hagen_unity target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${HAGEN_UNITY_BUILD} UNITY_BUILD_BATCH_SIZE 25)
  # Types in anonymous namespaces are used in one source only, even within batches.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  foreach(source ${ARGN})
    file(STRINGS ${source} per_target REGEX "foreach_target.h" LIMIT_COUNT 1)
    if(per_target)
      set_property(SOURCE ${source} PROPERTY SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endforeach()
endfunction()

# hagen_library(NAME): creates the library hagen::NAME from all sources in this folder. Public
# headers in include/hagen/NAME are installed; private headers are next to the sources and included
# by their path in libs/. Exported as component NAME of find_package(hagen).
function(hagen_library name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} *.cpp)
  list(FILTER sources EXCLUDE REGEX "^pcl/")
  add_library(hagen_${name} ${sources})
  hagen_unity(hagen_${name} ${sources})
  set_property(GLOBAL APPEND PROPERTY HAGEN_LIBRARIES ${name})
  add_library(hagen::${name} ALIAS hagen_${name})
  hagen_target(hagen_${name})
  target_include_directories(
    hagen_${name}
    PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  # Before 1.0, a minor version may change the ABI (CONTRIBUTING.md).
  set(abi ${PROJECT_VERSION_MAJOR})
  if(abi EQUAL 0)
    set(abi 0.${PROJECT_VERSION_MINOR})
  endif()
  # No macro -Dhagen_NAME_EXPORTS: static and shared libraries contain the same objects.
  set_target_properties(
    hagen_${name}
    PROPERTIES EXPORT_NAME ${name}
               POSITION_INDEPENDENT_CODE ON
               DEFINE_SYMBOL ""
               VERSION ${PROJECT_VERSION}
               SOVERSION ${abi})
  if(NOT HAGEN_INSTALL)
    return()
  endif()
  if(name MATCHES "^(scan|filter)$")
    set(runtime filter)
  else()
    set(runtime mrpt)
  endif()
  install(
    TARGETS hagen_${name}
    EXPORT hagen_${name}Targets
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${runtime} NAMELINK_COMPONENT dev
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev)
endfunction()

# hagen_program(NAME): settings of a program, which is installed with its manual page and
# completions. The page is generated from --help, so cross builds without an emulator have none.
set(HAGEN_ZSH_COMPLETIONS ${CMAKE_INSTALL_DATADIR}/zsh/site-functions CACHE STRING "Folder of completions for zsh")
find_program(HAGEN_HELP2MAN help2man)
function(hagen_program name)
  hagen_target(${name})
  set_property(GLOBAL APPEND PROPERTY HAGEN_PROGRAMS ${name})
  set(share ${PROJECT_BINARY_DIR}/share)
  set(bash ${share}/bash-completion/completions/${name})
  set(zsh ${share}/zsh/site-functions/_${name})
  configure_file(${PROJECT_SOURCE_DIR}/cmake/completions/program.bash.in ${bash} @ONLY)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/completions/program.zsh.in ${zsh} @ONLY)
  set(man "")
  if(HAGEN_HELP2MAN AND (NOT CMAKE_CROSSCOMPILING OR CMAKE_CROSSCOMPILING_EMULATOR))
    set(page ${share}/man/man1/${name}.1)
    file(MAKE_DIRECTORY ${share}/man/man1)
    set(man ${page})
    set(compress "")
    if(HAGEN_DEBIAN_PACKAGES)
      set(compress COMMAND gzip -9nf ${page})
      set(man ${page}.gz)
    endif()
    set(write_manual ${PROJECT_SOURCE_DIR}/cmake/write-manual)
    add_custom_command(
      OUTPUT ${man}
      COMMAND ${write_manual} ${page} $<TARGET_FILE:${name}> ${CMAKE_CROSSCOMPILING_EMULATOR}
      ${compress}
      DEPENDS ${name} ${write_manual}
      COMMENT "Writing the manual page of ${name}"
      VERBATIM)
    add_custom_target(${name}-manual ALL DEPENDS ${man})
  endif()
  if(HAGEN_INSTALL)
    install(TARGETS ${name} COMPONENT tools)
    install(FILES ${bash} DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT tools)
    install(FILES ${zsh} DESTINATION ${HAGEN_ZSH_COMPLETIONS} COMPONENT tools)
    install(FILES ${man} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tools)
  endif()
endfunction()
