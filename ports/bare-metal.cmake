# SPDX-License-Identifier: MIT
# What the toolchain files of all emulated boards share: no operating system, no library but the compiler's, programs
# that QEMU runs by semihosting.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)  # no program links without start-up code
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(lqg_semihosting -nographic -monitor none -serial none -chardev stdio,id=pc
                    -semihosting-config enable=on,target=native,chardev=pc -kernel)

# For programs that speak over the UART instead: it is QEMU's standard input and output. Each instruction takes
# 2^lqg_shift ns of virtual time, so the counter of the board counts instructions. lqg_unused_uarts are those before the
# one that is used.
set(lqg_serial -nographic -monitor none ${lqg_unused_uarts} -serial stdio -semihosting-config enable=on,target=native
               -icount shift=${lqg_shift} -kernel)
