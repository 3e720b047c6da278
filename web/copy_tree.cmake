# Copies what npm works on to TO, laid out as in the repository. Called with -DFROM= -DTO=.
foreach(folder IN ITEMS shaders web/three-lambent/data web/three-lambent/src web/three-lambent/scripts web/viewer/src
        web/viewer/element web/viewer/public web/viewer/scripts)
  file(REMOVE_RECURSE ${TO}/${folder})
  get_filename_component(parent ${TO}/${folder} DIRECTORY)
  file(COPY ${FROM}/${folder} DESTINATION ${parent})
endforeach()
foreach(file IN ITEMS LICENSE web/three-lambent/package.json web/three-lambent/tsconfig.json
        web/viewer/index.html web/viewer/package.json web/viewer/package-lock.json
        web/viewer/tsconfig.json web/viewer/vite.config.ts)
  get_filename_component(parent ${TO}/${file} DIRECTORY)
  file(COPY ${FROM}/${file} DESTINATION ${parent})
endforeach()
