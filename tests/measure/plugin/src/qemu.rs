//! The interface of QEMU: the functions that it calls and that are called here.
//!
//! From `qemu-plugin.h`, API 1 (QEMU 7.2) and, with the feature `api-3`, API 3 (QEMU 9.1 and
//! later). Of the functions used, these differ in one.

#![expect(unsafe_code, reason = "QEMU has a C interface")]

use std::{
    ffi::{CStr, c_char, c_int, c_uint, c_void},
    fs,
    path::PathBuf,
    process,
    sync::{Mutex, PoisonError},
};

use crate::{
    arguments::Arguments, instruction::Instruction, predictor::Predictor, riscv, thumb,
    windows::Windows,
};

/// A plugin's number.
type Id = u64;
/// A block or an instruction of QEMU, or a number that it passes on to a callback.
type Handle = *mut c_void;

/// What QEMU tells of itself. It has more fields, which are not read.
#[repr(C)]
struct Info {
    target_name: *const c_char,
}

/// That a callback reads no registers.
const NO_REGISTERS: c_int = 0;
/// That a callback hears of loads and stores. QEMU 7.2 never calls one that wants loads alone.
const LOADS_AND_STORES: c_int = 3;

unsafe extern "C" {
    fn qemu_plugin_register_vcpu_tb_trans_cb(id: Id, callback: extern "C" fn(Id, Handle));
    fn qemu_plugin_register_vcpu_tb_exec_cb(
        block: Handle,
        callback: extern "C" fn(c_uint, Handle),
        flags: c_int,
        data: Handle,
    );
    fn qemu_plugin_register_vcpu_mem_cb(
        instruction: Handle,
        callback: extern "C" fn(c_uint, u32, u64, Handle),
        flags: c_int,
        accesses: c_int,
        data: Handle,
    );
    fn qemu_plugin_register_atexit_cb(id: Id, callback: extern "C" fn(Id, Handle), data: Handle);
    fn qemu_plugin_tb_n_insns(block: Handle) -> usize;
    fn qemu_plugin_tb_vaddr(block: Handle) -> u64;
    fn qemu_plugin_tb_get_insn(block: Handle, index: usize) -> Handle;
    fn qemu_plugin_insn_size(instruction: Handle) -> usize;
    #[cfg(not(feature = "api-3"))]
    fn qemu_plugin_insn_data(instruction: Handle) -> *const u8;
    #[cfg(feature = "api-3")]
    fn qemu_plugin_insn_data(instruction: Handle, bytes: *mut u8, length: usize) -> usize;
}

/// The version of the interface that this plugin is written for. QEMU refuses others than its own
/// range.
#[unsafe(no_mangle)]
static qemu_plugin_version: c_int = if cfg!(feature = "api-3") { 3 } else { 1 };

struct Plugin {
    windows: Windows,
    out: PathBuf,
    decode: fn([u8; 4]) -> Instruction,
}

/// QEMU calls from the thread of the one core that the boards have, and at the end from another.
static PLUGIN: Mutex<Option<Plugin>> = Mutex::new(None);

fn with_plugin(work: impl FnOnce(&mut Plugin)) {
    // A panic in a callback ends the process, so there is no other thread left to see the poison.
    let mut plugin = PLUGIN.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(plugin) = &mut *plugin {
        work(plugin);
    }
}

/// A block is translated: decodes it, and wants to hear of its runs and of its accesses.
extern "C" fn translated(_: Id, block: Handle) {
    // SAFETY: QEMU passes a block, which is valid during this call; so are its instructions, whose
    // indices are below their number.
    let (start, handles) = unsafe {
        let handles = (0..qemu_plugin_tb_n_insns(block))
            .map(|index| qemu_plugin_tb_get_insn(block, index))
            .collect::<Vec<_>>();
        (qemu_plugin_tb_vaddr(block) as u32, handles)
    };
    with_plugin(|plugin| {
        let decoded = handles.iter().map(|&handle| (plugin.decode)(bytes(handle)));
        let instructions: Vec<_> = decoded.collect();
        let number = plugin.windows.add(start, &instructions);
        // SAFETY: block and instructions are valid as above, the callbacks have the signatures that
        // QEMU calls them by, and the data is a number, which nothing dereferences.
        unsafe {
            qemu_plugin_register_vcpu_tb_exec_cb(block, executed, NO_REGISTERS, number as Handle);
            for (index, (&handle, instruction)) in handles.iter().zip(&instructions).enumerate() {
                if plugin.windows.watches(instruction) {
                    let data = (number << INDEX_BITS | index) as Handle;
                    let accesses = LOADS_AND_STORES;
                    qemu_plugin_register_vcpu_mem_cb(
                        handle,
                        accessed,
                        NO_REGISTERS,
                        accesses,
                        data,
                    );
                }
            }
        }
    });
}

/// A block of QEMU has at most 512 instructions.
const INDEX_BITS: u32 = 10;

/// The bytes of an instruction, then zeros. At the end of a page, QEMU 7.2 gives a 16-bit
/// instruction together with the next one.
fn bytes(instruction: Handle) -> [u8; 4] {
    let mut bytes = [0; 4];
    // SAFETY: the caller passes an instruction that is valid during this call. It has at least as
    // many bytes as its size says, and no more than `bytes` are copied.
    unsafe {
        let length = qemu_plugin_insn_size(instruction).min(bytes.len());
        #[cfg(not(feature = "api-3"))]
        qemu_plugin_insn_data(instruction).copy_to_nonoverlapping(bytes.as_mut_ptr(), length);
        #[cfg(feature = "api-3")]
        qemu_plugin_insn_data(instruction, bytes.as_mut_ptr(), length);
    }
    bytes
}

/// A block begins to run.
extern "C" fn executed(_: c_uint, number: Handle) {
    with_plugin(|plugin| plugin.windows.executed(number as usize));
}

/// An instruction loads or stores.
extern "C" fn accessed(_: c_uint, _: u32, address: u64, data: Handle) {
    let (number, index) = (data as usize >> INDEX_BITS, data as usize & ((1 << INDEX_BITS) - 1));
    with_plugin(|plugin| plugin.windows.accessed(number, index, address as u32));
}

/// QEMU ends: writes the reports.
extern "C" fn ended(_: Id, _: Handle) {
    with_plugin(|plugin| {
        if let Err(error) = fs::write(&plugin.out, plugin.windows.reports()) {
            eprintln!("cycles plugin: {}: {error}", plugin.out.display());
            process::abort();
        }
    });
}

/// Starts the plugin. Returns 0 if all is well.
///
/// # Safety
///
/// QEMU calls it once, as its documentation says: `info` is valid, `argv` has `argc` strings.
#[unsafe(no_mangle)]
unsafe extern "C" fn qemu_plugin_install(
    id: Id,
    info: *const Info,
    argc: c_int,
    argv: *const *const c_char,
) -> c_int {
    // SAFETY: by this function's own condition.
    let (target, arguments) = unsafe {
        let string = |text: *const c_char| CStr::from_ptr(text).to_string_lossy().into_owned();
        let arguments = (0..argc as usize).map(|index| string(*argv.add(index)));
        (string((*info).target_name), arguments.collect::<Vec<_>>())
    };
    let Arguments { out, marks, flash } =
        match Arguments::parse(arguments.iter().map(String::as_str)) {
            Ok(arguments) => arguments,
            Err(fault) => {
                eprintln!("cycles plugin: {fault}");
                return 1;
            }
        };
    let is_riscv = target.starts_with("riscv");
    let decode = if is_riscv { riscv::decode } else { thumb::decode };
    let predictor = is_riscv.then(Predictor::default);
    let plugin = Plugin { windows: Windows::new(marks, flash, predictor), out, decode };
    *PLUGIN.lock().unwrap_or_else(PoisonError::into_inner) = Some(plugin);
    // SAFETY: the callbacks have the signatures that QEMU calls them by, and need no data.
    unsafe {
        qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
        qemu_plugin_register_atexit_cb(id, ended, std::ptr::null_mut());
    }
    0
}
