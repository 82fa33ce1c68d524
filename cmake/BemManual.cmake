# Manual pages, which help2man makes of what the programs print with --help.
find_program(BEM_HELP2MAN help2man)
mark_as_advanced(BEM_HELP2MAN)
set(BEM_MANUAL ${PROJECT_BINARY_DIR}/man)

# bem_manual_page(NAME PROGRAM DESCRIPTION [DEPENDENCIES...])
function(bem_manual_page name program description)
  set(page ${BEM_MANUAL}/${name}.1)
  add_custom_command(
    OUTPUT ${page}
    COMMAND ${BEM_HELP2MAN} --no-info --section 1 --name ${description} --version-string ${PROJECT_VERSION} --source "bem ${PROJECT_VERSION}"
            --manual "User Commands" --include ${PROJECT_SOURCE_DIR}/packaging/see-also.man --output ${page}
            "${PROJECT_SOURCE_DIR}/packaging/help_for_man.sh ${program}"
    DEPENDS ${ARGN} ${PROJECT_SOURCE_DIR}/packaging/see-also.man ${PROJECT_SOURCE_DIR}/packaging/help_for_man.sh
    VERBATIM)
  set_property(GLOBAL APPEND PROPERTY BEM_MANUAL_PAGES ${page})
endfunction()

if(NOT BEM_HELP2MAN)
  message(STATUS "There will be no manual pages: help2man is not installed (scripts/setup.sh)")
  return()
endif()
file(MAKE_DIRECTORY ${BEM_MANUAL})
bem_manual_page(bemprecomp $<TARGET_FILE:bemprecomp> "compute the matrices of an elastic body from its surface mesh and material" bemprecomp)
bem_manual_page(bemsim $<TARGET_FILE:bemsim> "simulate a scene of deformable bodies and write their trajectories" bemsim)
bem_manual_page(bemshape $<TARGET_FILE:bemshape> "write, mend, remesh, wrap or split closed surface meshes" bemshape)
bem_manual_page(bemmeasure $<TARGET_FILE:bemmeasure> "measure a trajectory of bemsim, or compare two" bemmeasure)
bem_manual_page(bemrecode $<TARGET_FILE:bemrecode> "compress a matrix archive of bemprecomp again" bemrecode)
if(TARGET bemview)
  bem_manual_page(bemview $<TARGET_FILE:bemview> "make a page for the browser of a trajectory of bemsim" bemview)
endif()
file(GLOB rendering CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/scripts/rendering/*.py)
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/scripts/render.py ${BEM_MANUAL}/bemrender SYMBOLIC)
bem_manual_page(bemrender ${BEM_MANUAL}/bemrender "draw pictures and videos of a trajectory of bemsim" ${PROJECT_SOURCE_DIR}/scripts/render.py ${rendering})

get_property(pages GLOBAL PROPERTY BEM_MANUAL_PAGES)
add_custom_target(manual ALL DEPENDS ${pages})
install(FILES ${pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 OPTIONAL)
