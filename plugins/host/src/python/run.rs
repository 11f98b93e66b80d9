//! Runs an interpreter and captures its output.

use std::io::{self, Read};
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use super::error::PythonError;

/// Timeout of a run. Reading modules from a slow disk takes seconds.
const PATIENCE: Duration = Duration::from_secs(30);
/// Polling interval.
const PAUSE: Duration = Duration::from_millis(5);
/// Maximum output that is kept, bytes.
const PRINTED_MAX: u64 = 4 << 20;

/// Runs `program` with `arguments` and no environment variables, and returns its standard output.
pub(super) fn output(program: &Path, arguments: &[&str]) -> Result<String, PythonError> {
    let start = |source: io::Error| PythonError::Start {
        program: program.to_owned(),
        source,
    };
    let silent = |problem: String| PythonError::Silent {
        program: program.to_owned(),
        problem,
    };
    let mut process = Command::new(program)
        .args(arguments)
        .env_clear()
        .current_dir("/")
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(start)?;
    let [printed, complained] = [
        process.stdout.take().map(reader),
        process.stderr.take().map(reader),
    ];
    let begun = Instant::now();
    let status = loop {
        match process.try_wait().map_err(start)? {
            Some(status) => break status,
            None if begun.elapsed() > PATIENCE => {
                // The kill fails if the process has already ended.
                let _ = process.kill();
                let _ = process.wait();
                return Err(silent(format!("it took longer than {PATIENCE:?}")));
            }
            None => thread::sleep(PAUSE),
        }
    };
    let text = |reader: Option<thread::JoinHandle<Vec<u8>>>| {
        let bytes = reader.and_then(|reader| reader.join().ok());
        String::from_utf8_lossy(&bytes.unwrap_or_default()).into_owned()
    };
    let (printed, complained) = (text(printed), text(complained));
    if status.success() {
        return Ok(printed);
    }
    let last = complained.trim().lines().last().unwrap_or_default();
    Err(silent(format!(
        "it ended with {status}: {}",
        crate::text::shown(last)
    )))
}

/// Starts a thread that reads the pipe, so the writer never blocks.
fn reader(mut pipe: impl Read + Send + 'static) -> thread::JoinHandle<Vec<u8>> {
    thread::spawn(move || {
        let mut bytes = Vec::new();
        // After a read error the output is incomplete, and the caller reports that.
        let _ = pipe.by_ref().take(PRINTED_MAX).read_to_end(&mut bytes);
        let _ = io::copy(&mut pipe, &mut io::sink());
        bytes
    })
}
