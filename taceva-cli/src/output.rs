//! Writes results to standard output, or atomically to a file.

mod guard;

use std::fs::File;
use std::io::{self, BufWriter, IsTerminal, Write};
use std::path::{Path, PathBuf};
use taceva_core::shown;

use anyhow::{Context as _, bail};

use crate::args::{Format, ListFormat};

pub(crate) use guard::Form;
use guard::Guard;

impl From<Format> for Form {
    fn from(format: Format) -> Form {
        match format {
            Format::Text | Format::Md => Form::Words,
            Format::Json => Form::Json,
            Format::Csv | Format::Tex => Form::Table,
        }
    }
}

impl From<ListFormat> for Form {
    fn from(format: ListFormat) -> Form {
        match format {
            ListFormat::Text => Form::Words,
            ListFormat::Json => Form::Json,
        }
    }
}

/// Fails before any work if `path` exists, unless `force` is set.
pub(crate) fn check_free(path: &Path, force: bool) -> anyhow::Result<()> {
    if path.exists() && !force {
        bail!("{} exists already; --force replaces it", shown(path));
    }
    Ok(())
}

/// Fails before any work if one of `paths` exists, unless `force` is set.
pub(crate) fn check_all_free<'p>(
    paths: impl IntoIterator<Item = &'p PathBuf>,
    force: bool,
) -> anyhow::Result<()> {
    let mut paths = paths.into_iter();
    paths.try_for_each(|path| check_free(path, force))
}

/// Width of the terminal at standard output, in characters; `None` without a terminal.
pub(crate) fn terminal_width() -> Option<usize> {
    let (width, _) = terminal_size::terminal_size_of(io::stdout())?;
    Some(usize::from(width.0))
}

/// Writes text to standard output, or a file of any kind to `path`.
///
/// Writes a file to a temporary path, syncs and renames it, so that the file is either absent or complete.
pub(crate) fn write(
    path: Option<&Path>,
    render: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> anyhow::Result<()> {
    match path {
        None => write_as(Form::Words, None, render),
        Some(path) => write_file(path, render),
    }
}

/// Writes a result in `form` to `path`, or to standard output. Escapes control characters as the form requires.
pub(crate) fn write_as(
    form: impl Into<Form>,
    path: Option<&Path>,
    render: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> anyhow::Result<()> {
    let form = form.into();
    if let Some(path) = path {
        return write_file(path, |out| guarded(form, out, render));
    }
    let out = io::stdout().lock();
    let form = match form {
        Form::Table if out.is_terminal() => Form::Words,
        form => form,
    };
    let mut out = BufWriter::new(out);
    match guarded(form, &mut out, render).and_then(|()| out.flush()) {
        // The reader closed the pipe.
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        result => result.context("cannot write to standard output"),
    }
}

fn guarded(
    form: Form,
    out: &mut dyn Write,
    render: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    if form == Form::Table {
        return render(out);
    }
    let mut guard = Guard::new(out, form);
    render(&mut guard)?;
    guard.finish().map(drop)
}

fn write_file(
    path: &Path,
    render: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> anyhow::Result<()> {
    taceva_files::replace(path, |staged| write_whole(staged, render))
        .with_context(|| format!("cannot write {}", shown(path)))
}

fn write_whole(
    path: &Path,
    render: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut out = BufWriter::new(File::create(path)?);
    render(&mut out)?;
    out.into_inner()
        .map_err(io::IntoInnerError::into_error)?
        .sync_all()
}
