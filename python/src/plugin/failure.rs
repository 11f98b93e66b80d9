//! Python exceptions as errors of devices and models.

use pyo3::exceptions::{
    PyConnectionError, PyEOFError, PyFileNotFoundError, PyModuleNotFoundError,
    PyNotImplementedError, PyPermissionError, PyRecursionError, PySyntaxError, PyTimeoutError,
    PyTypeError, PyValueError,
};
use pyo3::prelude::*;
use taceva_core::{DriverError, DriverKey, ErrorKind, Fault};

use super::waiting::Interrupted;

/// Failed operation, in words that follow "cannot". While a device is opened, an invalid value is an error in the caller's argument.
#[derive(Clone, Copy, Debug)]
pub(super) enum Doing {
    Opening(&'static str),
    Working(&'static str),
}

/// Converts the exception `error` to a failure of the device `key`.
pub(super) fn device_error(
    py: Python<'_>,
    error: &PyErr,
    key: &DriverKey,
    doing: Doing,
) -> DriverError {
    let kind = kind(py, error);
    let (kind, doing) = match doing {
        Doing::Opening(doing) if is_of_value(py, error) => (ErrorKind::InvalidArgument, doing),
        Doing::Opening(doing) | Doing::Working(doing) => (kind, doing),
    };
    let failed = DriverError::new(kind, key, doing).because(short_words(py, error));
    match fault(py, error) {
        Some(fault) => failed.with_fault(fault),
        None => failed,
    }
}

/// Reason why a device stopped itself, if the exception names a reason.
fn fault(py: Python<'_>, error: &PyErr) -> Option<Fault> {
    let named = error.value(py).getattr("fault").ok()?;
    let named: String = named.extract().ok()?;
    let mut faults = Fault::ALL.into_iter();
    faults.find(|fault| fault.to_string() == named)
}

fn is_of_value(py: Python<'_>, error: &PyErr) -> bool {
    error.is_instance_of::<PyValueError>(py) || error.is_instance_of::<PyTypeError>(py)
}

/// Kind of an exception: its attribute `kind`, or else the kind of its `errno` or of its class.
pub(super) fn kind(py: Python<'_>, error: &PyErr) -> ErrorKind {
    let named = error.value(py).getattr("kind").ok();
    let named = named.and_then(|kind| kind.extract::<String>().ok());
    let named = named.and_then(|name| {
        let mut kinds = ErrorKind::ALL.into_iter();
        kinds.find(|kind| kind.to_string() == name)
    });
    if let Some(kind) = named {
        return kind;
    }
    const EBUSY: i32 = 16;
    let number = error.value(py).getattr("errno").ok();
    let is_busy = number.and_then(|number| number.extract::<i32>().ok()) == Some(EBUSY);
    if is_busy {
        ErrorKind::Busy
    } else if error.is_instance_of::<Interrupted>(py) {
        ErrorKind::Interrupted
    } else if error.is_instance_of::<PyTimeoutError>(py) {
        ErrorKind::Timeout
    } else if error.is_instance_of::<PyFileNotFoundError>(py) {
        ErrorKind::NotFound
    } else if error.is_instance_of::<PyPermissionError>(py) {
        ErrorKind::PermissionDenied
    } else if error.is_instance_of::<PyConnectionError>(py) {
        ErrorKind::Disconnected
    } else if error.is_instance_of::<PyEOFError>(py) {
        ErrorKind::EndOfStream
    } else if error.is_instance_of::<PyNotImplementedError>(py) {
        ErrorKind::Unsupported
    } else {
        ErrorKind::DeviceFault
    }
}

/// Greatest size of an error message in the plugin interface, in bytes.
const ERROR_MAX: usize = taceva_plugin::abi::MESSAGE_SIZE - 1;
/// Size of an exception text, in bytes, that always fits into the reply of a process.
const ANSWER_MAX: usize = 1_900;

/// The exception on one line: class, message, remedy, and the innermost file and line.
pub(super) fn words(py: Python<'_>, error: &PyErr) -> String {
    words_within(py, error, ANSWER_MAX)
}

/// The exception on one line, like [`words`], shortened to the size of an error message in the plugin interface.
pub(super) fn short_words(py: Python<'_>, error: &PyErr) -> String {
    words_within(py, error, ERROR_MAX)
}

fn words_within(py: Python<'_>, error: &PyErr, room: usize) -> String {
    let name = error.get_type(py).name();
    let name = name.map_or_else(|_| "an exception".to_owned(), |name| name.to_string());
    let message = error.value(py).str();
    let message = message.map_or_else(|_| String::new(), |message| message.to_string());
    let unread = unread_line(py, error);
    let message = unread
        .as_ref()
        .map_or(message, |(message, _)| message.clone());
    let (said, mut behind) = match message.trim() {
        "" => (name, String::new()),
        // Message of the dynamic loader for a library that is loaded too late.
        message if message.contains(TOO_LATE) => {
            let module = error.value(py).getattr("name").ok();
            let module = module.and_then(|module| module.extract::<String>().ok());
            let late = module.as_deref().unwrap_or_else(|| library(message));
            let remedy = "; name its module in `preload` of plugin.toml, or set `profile = \"interpreter-open\"`";
            (format!("{name}: {late}: {TOO_LATE}"), remedy.to_owned())
        }
        message => (format!("{name}: {message}"), String::new()),
    };
    if said.contains(NO_PRIMITIVE) {
        behind.push_str(ONEDNN);
    }
    if error.is_instance_of::<PyModuleNotFoundError>(py) {
        behind.push_str("; install it in the environment of the plugin");
    }
    if error.is_instance_of::<PyRecursionError>(py) {
        behind.push_str("; the plugin recurses too deeply");
    }
    let place = unread.map(|(_, place)| place);
    if let Some(place) = place.or_else(|| self::place(py, error)) {
        behind.push_str(&format!(" ({place})"));
    }
    // A path that fills the space is shortened like the message.
    let behind = shortened(&behind, room / 2);
    let said = shortened(&said, room - behind.len());
    said + &behind
}

/// Shortens `text` to `room` bytes: keeps the beginning and the end, and states the number of omitted characters between them.
fn shortened(text: &str, room: usize) -> String {
    /// Greatest size, in bytes, of the text that states how many characters are omitted.
    const BETWEEN: usize = 48;
    if text.len() <= room || room < 2 * BETWEEN {
        return text.to_owned();
    }
    let half = (room - BETWEEN) / 2;
    let (mut end, mut begin) = (half, text.len() - half);
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    while !text.is_char_boundary(begin) {
        begin += 1;
    }
    let missing = text[end..begin].chars().count();
    format!(
        "{} [… {missing} characters left out …] {}",
        &text[..end],
        &text[begin..]
    )
}

/// Message of oneDNN, which generates code at run time; a confined process cannot execute such code.
const NO_PRIMITIVE: &str = "could not create a primitive";
const ONEDNN: &str = "; oneDNN writes code: import torch at the top of the module, or call torch.backends.mkldnn.set_flags(False)";

const TOO_LATE: &str = "failed to map segment";

/// File name in the message of the loader, without its folder.
fn library(message: &str) -> &str {
    let path = message.split(": ").next().unwrap_or(message);
    path.rsplit('/').next().unwrap_or(path)
}

/// For a syntax error, its message, and the file and line that Python could not parse. The text of the exception has no folder of the file.
fn unread_line(py: Python<'_>, error: &PyErr) -> Option<(String, String)> {
    if !error.is_instance_of::<PySyntaxError>(py) {
        return None;
    }
    let error = error.value(py);
    let message: String = error.getattr("msg").ok()?.extract().ok()?;
    let file: String = error.getattr("filename").ok()?.extract().ok()?;
    let line: u32 = error.getattr("lineno").ok()?.extract().ok()?;
    Some((message, line_of(&file, line)))
}

/// File and line as text, for messages.
pub(super) fn line_of(file: &str, line: u32) -> String {
    format!("{file}, line {line}")
}

/// Innermost file and line of the traceback of the exception, in the code of the plugin if there is one.
fn place(py: Python<'_>, error: &PyErr) -> Option<String> {
    let own = own_folder(py);
    let mut trace = error.traceback(py)?.into_any();
    let mut innermost = None;
    loop {
        let line: u32 = trace.getattr("tb_lineno").ok()?.extract().ok()?;
        let code = trace.getattr("tb_frame").ok()?.getattr("f_code").ok()?;
        let file: String = code.getattr("co_filename").ok()?.extract().ok()?;
        // Functions of this package and of the interpreter itself are not code of the plugin.
        let is_own =
            file.starts_with("<frozen ") || own.as_deref().is_some_and(|own| file.starts_with(own));
        if innermost.is_none() || !is_own {
            innermost = Some(line_of(&file, line));
        }
        match trace.getattr("tb_next") {
            Ok(next) if !next.is_none() => trace = next,
            _ => return innermost,
        }
    }
}

/// Folder of the package `taceva`, with `/` at its end; `None` before its import.
fn own_folder(py: Python<'_>) -> Option<String> {
    let modules = py.import("sys").ok()?.getattr("modules").ok()?;
    let package = modules.get_item("taceva").ok()?;
    let file: String = package.getattr("__file__").ok()?.extract().ok()?;
    file.strip_suffix("__init__.py").map(str::to_owned)
}
