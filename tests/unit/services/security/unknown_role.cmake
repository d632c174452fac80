# Checks the roles of a program, the second of which is none: the test looks for the words of the error.
cmake_minimum_required(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/../../../../cmake/ProgramRoles.cmake")
roci_check_roles(chess_svc executive king)
