# Run at every build (cmake -P): fills in base/version.h from the state of the git checkout. The file is
# touched only when its text changes, so that nothing is compiled again without need.
# In: source_dir template output git version compiler flags build_type
set(commit unknown)
set(modified 0)

function(ask_git result)
  execute_process(COMMAND ${git} -C ${source_dir} ${ARGN} OUTPUT_VARIABLE answer ERROR_QUIET RESULT_VARIABLE status
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT status EQUAL 0)
    set(answer "")
  endif()
  set(${result} "${answer}" PARENT_SCOPE)
endfunction()

# An unpacked archive inside somebody else's checkout has no commit of its own (.git is a file in a worktree).
if(git AND EXISTS ${source_dir}/.git)
  ask_git(head rev-parse HEAD)
  if(head)
    set(commit ${head})
    ask_git(changes status --porcelain -- CMakeLists.txt external shaders source)
    if(changes)
      set(modified 1)
    endif()
  endif()
endif()

string(REPLACE "\\" "\\\\" flags "${flags}")
string(REPLACE "\"" "\\\"" flags "${flags}")
configure_file(${template} ${output} @ONLY)
