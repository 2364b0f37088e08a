//! A master in C, compiled by the system's C compiler, drives the shared library through `dlopen`:
//! every function with the types of the C standard, messages through a variadic logger, many
//! instances in threads, a state from one process to another.

use fretting_contact::fmi2::GUID;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;
use std::{env, fs};

/// The program.
static MASTER: LazyLock<PathBuf> = LazyLock::new(|| {
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join("c_master");
    let compiler = env::var("CC").unwrap_or_else(|_| "cc".to_owned());
    let compiled = Command::new(compiler)
        .args(["-std=gnu11", "-Wall", "-Wextra", "-Werror", "-O1", "-o"])
        .arg(&program)
        .args(["tests/c/master.c", "-ldl", "-lpthread"])
        .output()
        .expect("a C compiler is there");
    assert!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));
    program
});

/// The library that cargo builds beside the tests.
fn library() -> PathBuf {
    env::current_exe().expect("the test has a path").with_file_name("libfretting_contact.so")
}

/// What the master prints at a task.
#[track_caller]
fn master(task: &[&str]) -> String {
    let mut program = Command::new(&*MASTER);
    let output = program.arg(library()).arg(GUID).args(task).output().expect("the program runs");
    assert!(output.status.success(), "{task:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8_lossy(&output.stdout).into_owned()
}

#[test]
fn every_function_does_for_a_c_host_what_the_standard_says() {
    master(&["abi"]);
}

/// 10,000 instances in eight threads.
#[test]
fn instances_in_threads_have_the_bits_of_single_runs() {
    master(&["many", "10000", "8"]);
}

#[test]
fn instances_may_be_made_and_freed_in_any_state_of_their_life() {
    master(&["loop", "300"]);
}

/// 110 kB stayed behind each time while the variable table was on the heap.
#[test]
fn a_library_that_is_loaded_and_unloaded_leaves_no_memory_behind() {
    print!("{}", master(&["reload", "1000"]));
}

#[test]
fn a_state_goes_on_in_another_process_with_the_same_bits() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("state");
    let path = Path::to_str(&file).expect("the path is UTF-8");
    let there = master(&["save", path]);
    assert_eq!(there.lines().count(), 4);
    assert_eq!(master(&["load", path]), there);
    let mut bytes = fs::read(&file).unwrap();
    *bytes.last_mut().unwrap() ^= 1;
    fs::write(&file, bytes).unwrap();
    let mut program = Command::new(&*MASTER);
    let output = program.arg(library()).arg(GUID).args(["load", path]).output().unwrap();
    assert!(String::from_utf8_lossy(&output.stderr).contains("its checksum does not fit"), "{output:?}");
}
