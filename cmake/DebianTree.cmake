# Run by cpack on the files of the package: gives documents the form that Debian's policy asks for.
set(doc ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr/share/doc/ncvet)
set(man ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr/share/man/man1/ncvet.1)

file(WRITE ${doc}/copyright
"Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: ncvet

Files: *
Copyright: 2026 the ncvet maintainers
License: Apache-2.0
 On Debian systems the full text of the Apache License, version 2.0, is in the
 file /usr/share/common-licenses/Apache-2.0.
")
file(REMOVE ${doc}/LICENSE)
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC) # of SOURCE_DATE_EPOCH, where it is set
file(WRITE ${doc}/changelog
"ncvet (${CPACK_PACKAGE_VERSION}) stable; urgency=medium

  * What has changed is in CHANGELOG.md, in this folder.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
# Without name and time of the file: the same bytes every time.
execute_process(COMMAND gzip -9n ${doc}/changelog ${man} COMMAND_ERROR_IS_FATAL ANY)
