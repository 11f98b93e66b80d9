//! What Python raises, as errors of devices and models.

use pyo3::exceptions::{
    PyConnectionError, PyEOFError, PyFileNotFoundError, PyModuleNotFoundError,
    PyNotImplementedError, PyPermissionError, PyTimeoutError, PyTypeError, PyValueError,
};
use pyo3::prelude::*;
use taceva_core::{DriverError, DriverKey, ErrorKind};

use super::waiting::Interrupted;

/// What was tried, in words that follow "cannot", and whether a value is the caller's: the arguments of a device that is opened are.
#[derive(Clone, Copy, Debug)]
pub(super) enum Doing {
    Opening(&'static str),
    Working(&'static str),
}

/// `error` as a failure of the device `key`.
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
    DriverError::new(kind, key, doing).because(words(py, error))
}

fn is_of_value(py: Python<'_>, error: &PyErr) -> bool {
    error.is_instance_of::<PyValueError>(py) || error.is_instance_of::<PyTypeError>(py)
}

/// The kind that an exception stands for: the one that it names, or that of its class.
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

/// What was raised and where, in one line: the class, its message, and the innermost file and line. What does not fit into an error of the
/// interface is cut, so the remedy stands before the place.
pub(super) fn words(py: Python<'_>, error: &PyErr) -> String {
    let name = error.get_type(py).name();
    let name = name.map_or_else(|_| "an exception".to_owned(), |name| name.to_string());
    let message = error.value(py).str();
    let message = message.map_or_else(|_| String::new(), |message| message.to_string());
    let mut words = match message.trim() {
        "" => name,
        // The loader's words for a library that comes too late.
        message if message.contains(TOO_LATE) => {
            let module = error.value(py).getattr("name").ok();
            let module = module.and_then(|module| module.extract::<String>().ok());
            let late = module.as_deref().unwrap_or_else(|| library(message));
            format!(
                "{name}: {late}: {TOO_LATE}; name its module in `preload` of plugin.toml, or set `profile = \"interpreter-open\"`"
            )
        }
        message => format!("{name}: {message}"),
    };
    if error.is_instance_of::<PyModuleNotFoundError>(py) {
        words.push_str("; install it in the environment of the plugin");
    }
    if let Some(place) = place(py, error) {
        words.push_str(&format!(" ({place})"));
    }
    words
}

const TOO_LATE: &str = "failed to map segment";

/// The file that the loader complains of, without its folder.
fn library(message: &str) -> &str {
    let path = message.split(": ").next().unwrap_or(message);
    path.rsplit('/').next().unwrap_or(path)
}

/// The innermost file and line that the exception passed.
fn place(py: Python<'_>, error: &PyErr) -> Option<String> {
    let mut trace = error.traceback(py)?.into_any();
    while let Ok(next) = trace.getattr("tb_next")
        && !next.is_none()
    {
        trace = next;
    }
    let line: u32 = trace.getattr("tb_lineno").ok()?.extract().ok()?;
    let code = trace.getattr("tb_frame").ok()?.getattr("f_code").ok()?;
    let file: String = code.getattr("co_filename").ok()?.extract().ok()?;
    Some(format!("{file}, line {line}"))
}
