# Programs of self-contained packages link Hagen's own libraries as archives, while shared libraries
# are built for the library packages. Archives contain the same objects, so nothing is compiled
# twice.

# hagen_archives_of(RESULT LIBRARY...): lists libraries, with archives in place of shared ones of
# Hagen.
function(hagen_archives_of result)
  set(archives "")
  foreach(library ${ARGN})
    if(library MATCHES "^hagen::([a-z_]+)$")
      hagen_archive(${CMAKE_MATCH_1})
      list(APPEND archives hagen_${CMAKE_MATCH_1}_archive)
    else()
      list(APPEND archives ${library})
    endif()
  endforeach()
  set(${result} ${archives} PARENT_SCOPE)
endfunction()

# hagen_archive(NAME): creates the target hagen_NAME_archive with the objects of hagen::NAME.
function(hagen_archive name)
  set(archive hagen_${name}_archive)
  if(TARGET ${archive})
    return()
  endif()
  add_library(${archive} STATIC EXCLUDE_FROM_ALL $<TARGET_OBJECTS:hagen_${name}>)
  set_target_properties(${archive} PROPERTIES LINKER_LANGUAGE CXX)
  target_include_directories(${archive} INTERFACE $<TARGET_PROPERTY:hagen_${name},INTERFACE_INCLUDE_DIRECTORIES>)
  target_compile_features(${archive} INTERFACE cxx_std_17)
  get_target_property(public hagen_${name} INTERFACE_LINK_LIBRARIES)
  get_target_property(all hagen_${name} LINK_LIBRARIES)
  foreach(library ${all})
    if(NOT library)
      continue()
    endif()
    hagen_archives_of(linked ${library})
    if(library IN_LIST public)
      target_link_libraries(${archive} INTERFACE ${linked})
    else()
      target_link_libraries(${archive} INTERFACE $<LINK_ONLY:${linked}>)
    endif()
  endforeach()
endfunction()

# hagen_link_archives(TARGET...): makes these targets link archives. Call it after all target_link_libraries().
function(hagen_link_archives)
  foreach(target ${ARGN})
    get_target_property(libraries ${target} LINK_LIBRARIES)
    hagen_archives_of(archives ${libraries})
    set_target_properties(${target} PROPERTIES LINK_LIBRARIES "${archives}")
  endforeach()
endfunction()
