# Installs the reader's npm packages into BUILD_DIR, once for each lock file.
#   cmake -DSOURCE_DIR=... -DBUILD_DIR=... -P install.cmake
file(SHA256 ${SOURCE_DIR}/package-lock.json lock)
set(stamp ${BUILD_DIR}/installed)
if(EXISTS ${stamp})
  file(READ ${stamp} installed)
endif()
if(NOT "${installed}" STREQUAL "${lock}")
  file(COPY ${SOURCE_DIR}/package.json ${SOURCE_DIR}/package-lock.json ${SOURCE_DIR}/.npmrc
       DESTINATION ${BUILD_DIR})
  find_program(NPM npm)
  if(NOT NPM)
    message(FATAL_ERROR "npm is not installed: run toolchain/install-dependencies")
  endif()
  execute_process(COMMAND ${NPM} ci WORKING_DIRECTORY ${BUILD_DIR} RESULT_VARIABLE result
                  OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "npm could not install the packages of tests/recording_reader, so what "
                        "we write was not checked by a reader that is not ours. Is the npm registry reachable? "
                        "npm said:\n${output}")
  endif()
  file(WRITE ${stamp} "${lock}")
endif()
# The scripts stand beside the packages, where Node.js looks for them.
file(COPY ${SOURCE_DIR}/read_recording.mjs ${SOURCE_DIR}/read_map.mjs DESTINATION ${BUILD_DIR})
