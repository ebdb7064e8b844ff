// Nothing but the precompiled headers of weft_test_headers (CMakeLists.txt).
