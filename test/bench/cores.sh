# SPDX-License-Identifier: MIT
# For bash scripts, to be sourced: how programs are built and run for a core, from its port's own files.
#
#   every_core             the cores that there are
#   select_core <core>     sets core, family, port, startup, fused_reals, cpu, compiler, archiver, size, linked,
#                          machine, megahertz; `options` go to the compiler
#   missing_tools          prints what the selected core needs and this machine has not

every_core=(cortex-m0 cortex-m3 cortex-m4f cortex-m7 cortex-m33 cortex-m55 rv32 rv32f rv64)

# The value of a variable in the port's toolchain file.
port_value() { sed -n "s/^set($1 *\"\{0,1\}\([^\")]*\)\"\{0,1\}).*/\1/p" "$port/toolchain.cmake"; }

select_core() {
  local emulated=(-nographic -monitor none -serial none -chardev stdio,id=pc
                  -semihosting-config "enable=on,target=native,chardev=pc" -kernel)
  core=$1 port=$lqg_root/ports/$1
  [ -e "$port/memory.ld" ] || lqg_stop "no core $core: expected one of ${every_core[*]}"
  read -ra cpu <<<"$(port_value lqg_cpu)"
  fused_reals=$(port_value LQG_FUSED_REALS)
  if [ "${core%-*}" = cortex ]; then
    select_cortex_m "$(port_value lqg_machine)"
  else
    select_riscv "$(port_value lqg_bits)"
  fi
  startup=$lqg_root/ports/$family/startup.c
  compiler+=("${cpu[@]}" -ffunction-sections -fdata-sections "${options[@]}" "-I$lqg_root/include")
  linked+=(-nostartfiles -Wl,--gc-sections -L "$port" -T "$lqg_root/ports/$family/link.ld")
  machine+=("${emulated[@]}")
}

# The clocks are those of the machines in QEMU's sources; counter_cortex-m.c counts wrong with another, and says so.
select_cortex_m() {
  family=cortex-m
  compiler=(arm-none-eabi-gcc -mthumb) archiver=arm-none-eabi-ar size=arm-none-eabi-size
  linked=(--specs=nano.specs)
  machine=(qemu-system-arm -machine "$1" -icount shift=8)
  case $1 in
    microbit) megahertz=16 ;;
    mps2-an505) megahertz=20 ;;
    mps3-an547) megahertz=32 ;;
    *) megahertz=25 ;;
  esac
}

select_riscv() {
  family=riscv
  compiler=(riscv64-unknown-elf-gcc -mcmodel=medany --specs=picolibc.specs)
  archiver=riscv64-unknown-elf-ar size=riscv64-unknown-elf-size
  linked=()
  machine=("qemu-system-riscv$1" -machine virt -bios none -icount shift=0)
  megahertz=0 # not asked for
}

missing_tools() {
  if ! lqg_has_command "${compiler[0]}"; then
    echo -n " ${compiler[0]}"
  elif ! echo '#include <stdio.h>' | "${compiler[@]}" -E -o /dev/null - 2>/dev/null; then
    echo -n " the C library of ${compiler[0]}"
  fi
  lqg_has_command "${machine[0]}" || echo -n " ${machine[0]}"
}
