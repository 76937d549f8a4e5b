//! What happens where standard output cannot be written: a full disk, say.

use std::panic::PanicHookInfo;

/// How `print!` and `println!` begin what they panic with.
const FAILED: &str = "failed printing to stdout: ";

/// Where something cannot be printed, the program ends with one line that says so, not with a panic. In one place, so that
/// whoever prints can use what everybody prints with.
pub fn end_where_it_cannot_be_written() {
    let otherwise = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| match reason(panic) {
        Some(reason) => {
            eprintln!("kapvik: standard output could not be written: {reason}");
            std::process::exit(1);
        }
        None => otherwise(panic),
    }));
}

/// Why it could not be written, where that is what the panic is of.
fn reason<'a>(panic: &'a PanicHookInfo<'_>) -> Option<&'a str> {
    panic.payload_as_str()?.strip_prefix(FAILED)
}
