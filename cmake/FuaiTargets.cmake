# Functions that make the project's targets: one static library a layer, one test program a layer.

find_program(FUAI_CCACHE ccache)
if(FUAI_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${FUAI_CCACHE}")
endif()

# Flags of every target of ours; nothing here is exported.
add_library(fuai_options INTERFACE)
target_compile_features(fuai_options INTERFACE cxx_std_20)
target_compile_options(fuai_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wold-style-cast -Wnon-virtual-dtor
  -Woverloaded-virtual -Wcast-qual -Wformat=2 -ffp-contract=off
  $<$<CXX_COMPILER_ID:GNU>:-Wduplicated-cond -Wlogical-op -Wno-restrict>  # -Wrestrict: false alarms of g++ 12 (bug 105651)
  $<$<BOOL:${FUAI_WERROR}>:-Werror>)
if(FUAI_ASSERTIONS)
  target_compile_definitions(fuai_options INTERFACE FUAI_ASSERTIONS=1)
endif()
if(FUAI_SANITIZE)
  # Global on purpose: every object of a sanitizer build has to be instrumented. Instrumentation confuses g++'s analysis
  # of what may be uninitialised (its manual says so); the release builds keep that warning.
  add_compile_options(-fsanitize=${FUAI_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  add_link_options(-fsanitize=${FUAI_SANITIZE})
  if(FUAI_SANITIZE STREQUAL "address,undefined")
    # A tenth of the compile time, for what ends the program here anyway: the address sanitizer reports the access.
    add_compile_options(-fno-sanitize=null)
  endif()
endif()

# What is tested is optimised, the tests themselves compile a quarter faster without; instrumented, twice as fast.
set(FUAI_TEST_FLAGS $<$<CONFIG:Release>:-O1>)
if(FUAI_SANITIZE)
  set(FUAI_TEST_FLAGS -O0)
endif()

# The address sanitizer's build compiles in two thirds of the time without optimisation; layers whose tests compute for
# long keep it.
set(FUAI_COMPUTING_LAYERS core fabric energy cloth solver sim scenes device haptics runtime laboratory)
set(FUAI_PLAIN_FLAGS)
if(FUAI_SANITIZE MATCHES "address")
  set(FUAI_PLAIN_FLAGS -O0)
endif()

# fuai_joined(<target>)
# Compiles a target's sources several at a time, those together that name nothing alike for themselves: a build from
# nothing then reads the headers a few times instead of hundreds of times.
function(fuai_joined target)
  if(NOT FUAI_JOIN)
    return()
  endif()
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${sources})
  execute_process(
    COMMAND ${Python3_EXECUTABLE} "${PROJECT_SOURCE_DIR}/tools/source_groups.py" 8 ${sources}
    WORKING_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" OUTPUT_VARIABLE lines OUTPUT_STRIP_TRAILING_WHITESPACE
    COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX REPLACE "\n" "|" lines "${lines}")
  string(REPLACE ";" ">" lines "${lines}")
  string(REPLACE "|" ";" lines "${lines}")
  foreach(line IN LISTS lines)
    string(REPLACE ">" ";" pair "${line}")
    list(GET pair 0 group)
    list(GET pair 1 source)
    set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "group${group}")
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# fuai_layer(<name> SOURCES ... HEADERS ... [PUBLIC libs...] [PRIVATE libs...])
# One layer of src/fuai/LAYERS as the static library fuai_<name>, alias fuai::<name>.
function(fuai_layer name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;HEADERS;PUBLIC;PRIVATE")
  set(target fuai_${name})
  add_library(${target} STATIC ${arg_SOURCES} ${arg_HEADERS})
  add_library(fuai::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE} $<BUILD_INTERFACE:fuai_options>)
  if(NOT name IN_LIST FUAI_COMPUTING_LAYERS)
    target_compile_options(${target} PRIVATE ${FUAI_PLAIN_FLAGS})
  endif()
  fuai_joined(${target})
  set_property(GLOBAL APPEND PROPERTY FUAI_LAYER_TARGETS ${target})
  foreach(header IN LISTS arg_HEADERS)
    set_property(GLOBAL APPEND PROPERTY FUAI_HEADERS "fuai/${name}/${header}")
  endforeach()
endfunction()

# fuai_tests(<layer> SOURCES ... LIBRARIES ...)
# One doctest program, and one CTest test for each TEST_SUITE name found in the sources. A suite's name is its
# kinds joined by "+" ("golden+slow"); each kind becomes a CTest label, so `ctest -L golden` works.
function(fuai_tests layer)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LIBRARIES")
  set(target test_${layer})
  add_executable(${target} ${arg_SOURCES})
  target_link_libraries(${target} PRIVATE fuai_test_support ${arg_LIBRARIES} fuai_options)
  target_compile_options(${target} PRIVATE ${FUAI_TEST_FLAGS})
  fuai_joined(${target})
  set(suites)
  foreach(source IN LISTS arg_SOURCES)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${source}")
    file(STRINGS ${source} lines REGEX "TEST_SUITE\\(\"[^\"]+\"\\)")
    foreach(line IN LISTS lines)
      string(REGEX REPLACE ".*TEST_SUITE\\(\"([^\"]+)\"\\).*" "\\1" suite "${line}")
      list(APPEND suites ${suite})
    endforeach()
  endforeach()
  list(REMOVE_DUPLICATES suites)
  foreach(suite IN LISTS suites)
    set(test "${layer}.${suite}")
    string(REPLACE "+" ";" labels "${suite}")
    add_test(NAME ${test} COMMAND ${target} "--test-suite=${suite}")
    set_tests_properties(${test} PROPERTIES LABELS "${labels};${layer}" TIMEOUT 900)
  endforeach()
endfunction()
