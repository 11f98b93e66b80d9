//! Names of pending calls, in words that follow "did not".

/// Loading of a library.
pub(super) const LOADING: &str = "load its library";
/// Import of a module of Python, as the host names it.
const IMPORTING: &str = "import its module";
/// Opening of a device, as the host names it.
pub(super) const OPENING: &str = "open the device";

/// True for a call that precedes every check of a plugin.
pub(super) fn is_loading(call: &str) -> bool {
    [LOADING, IMPORTING].contains(&call)
}
