# relief_configure(TARGET): the compiler settings that every target of this tree shares.
function(relief_configure target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
    -Wold-style-cast -Woverloaded-virtual)
  if(RELIEF_WERROR)
    # -Wnull-dereference not without it: at the release preset's -O3, GCC 12 suspects std::vector::resize.
    target_compile_options(${target} PRIVATE -Wnull-dereference -Werror)
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
    # GCC 13 and 14 see members of a std::variant that it does not hold at the time.
    target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized)
  endif()
  if(RELIEF_SANITIZE)
    # GCC 12 sees -Wnull-dereference and -Wmaybe-uninitialized where the sanitizers add their own branches.
    target_compile_options(${target} PRIVATE -fsanitize=${RELIEF_SANITIZE} -fno-omit-frame-pointer
      -Wno-null-dereference -Wno-maybe-uninitialized)
    target_link_options(${target} PUBLIC -fsanitize=${RELIEF_SANITIZE})
  endif()
  if(RELIEF_NATIVE)
    target_compile_options(${target} PRIVATE -march=native)
  endif()
endfunction()

# A compiler cache, where there is one, saves most of a second build in another folder.
find_program(RELIEF_CCACHE ccache)
if(RELIEF_CCACHE AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${RELIEF_CCACHE}")
endif()

# relief_test(NAME SOURCES... [LIBS ...] [LABELS ...]): one GoogleTest program, each of its tests known to
# ctest.
function(relief_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBS;LABELS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LIBS} GTest::gtest_main)
  relief_configure(${name})
  # GCC 12 sees null pointers in std::vector<nlohmann::json> behind GoogleTest's macros; there are none.
  # -O1 compiles a fifth to a third faster than -O2. With -O0 half of the time is saved, and more than that lost
  # when the tests run.
  target_compile_options(${name} PRIVATE -Wno-null-dereference -O1)
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300 LABELS "${ARG_LABELS}")
endfunction()
