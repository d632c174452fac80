# cmake -DFILES="a.cxx;b.cxx" -P BoundEnumSequences.cmake
# fastddsgen 2.3 resizes a sequence of enums to whatever length a sample claims, up to 16 GB, before it reads one
# element. This makes the generated code look first whether so many bytes are there, as all other sequences do.
foreach(file ${FILES})
  file(READ "${file}" text)
  string(REGEX REPLACE "(\n *)(m_[a-z_]+\\.resize\\(seq_length\\);)"
         "\\1auto before_elements = dcdr.getState();\\1if (!dcdr.jump(sizeof(uint32_t) * size_t(seq_length)))\
\\1    throw eprosima::fastcdr::exception::NotEnoughMemoryException(\
\\1            eprosima::fastcdr::exception::NotEnoughMemoryException::NOT_ENOUGH_MEMORY_MESSAGE_DEFAULT);\
\\1dcdr.setState(before_elements);\\1\\2" bounded "${text}")
  if(NOT bounded STREQUAL text)
    file(WRITE "${file}" "${bounded}")
  endif()
endforeach()
