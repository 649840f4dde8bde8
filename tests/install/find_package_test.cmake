# Installs the library without its tools into an empty prefix; then configures, builds and runs a project that finds it there.
function(run)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(NOT result EQUAL 0)
        list(JOIN ARGN " " command)
        message(FATAL_ERROR "${command}\n${output}")
    endif()
endfunction()

file(REMOVE_RECURSE ${work})
set(configure ${CMAKE_COMMAND} -G ${generator} -DCMAKE_CXX_COMPILER=${compiler})

run(${configure} -S ${source} -B ${work}/clv -DCLV_BUILD_TOOLS=OFF -DCMAKE_INSTALL_PREFIX=${work}/prefix)
run(${CMAKE_COMMAND} --install ${work}/clv)

# Nothing of the source tree may be needed any more, so the project is copied out of it.
file(COPY ${CMAKE_CURRENT_LIST_DIR}/consumer DESTINATION ${work})
run(${configure} -S ${work}/consumer -B ${work}/build -DCMAKE_PREFIX_PATH=${work}/prefix -Dexpected_version=${version})
run(${CMAKE_COMMAND} --build ${work}/build)
run(${work}/build/consumer)
