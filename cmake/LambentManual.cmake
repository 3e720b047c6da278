# Manual pages and completions of the tool, made by the tool itself of the texts of its --help:
# cmake -DTOOL=… -DFOLDER=… -P LambentManual.cmake
set(man ${FOLDER}/share/man/man1)
set(bash ${FOLDER}/share/bash-completion/completions)
set(zsh ${FOLDER}/share/zsh/site-functions)
set(fish ${FOLDER}/share/fish/vendor_completions.d)
file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${man} ${bash} ${zsh} ${fish})

execute_process(COMMAND ${TOOL} help --man-pages ${man} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${TOOL} completion bash OUTPUT_FILE ${bash}/lambent
                COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${TOOL} completion zsh OUTPUT_FILE ${zsh}/_lambent
                COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${TOOL} completion fish OUTPUT_FILE ${fish}/lambent.fish
                COMMAND_ERROR_IS_FATAL ANY)
file(TOUCH ${FOLDER}/made)
