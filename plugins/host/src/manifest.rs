//! Manifest of a plugin, with all data for listing and planning. Reading a manifest runs no code of the plugin.

mod argument;
mod device_facts;
mod error;
mod library;
mod need;
mod program;
mod provides;
mod provides_table;
mod usb_id;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use serde::Deserialize;
use taceva_abi::{ABI_MAJOR, ABI_MINOR};
use taceva_core::{Descriptor, DriverKey, suggestion};
use toml::Spanned;

pub use self::error::ManifestError;
use self::library::PLATFORMS;
pub(crate) use self::library::path_fault;
pub use self::library::{LibraryFile, Sha256Digest, platform};
pub(crate) use self::need::matches;
pub use self::need::{DeclaredNeed, Need, NeedError};
use self::program::WrittenProgram;
pub use self::program::{Profile, PythonModule};
pub use self::provides::{EstimatorInfo, Provided};
use self::provides_table::WrittenProvides;
pub use self::usb_id::UsbId;
use crate::id::PluginId;
use crate::text::shown;

/// Supported manifest version.
const VERSION: u32 = 1;
/// Maximum length of a manifest, bytes.
pub(crate) const BYTES_MAX: usize = 1 << 20;
/// Maximum number of drivers and estimators of a plugin.
const PROVIDES_MAX: usize = 256;

/// Content of a `plugin.toml`.
///
/// ```
/// use taceva_host::Manifest;
/// let manifest = Manifest::parse(r#"
///     manifest_version = 1
///     id = "org.example.digit"
///     name = "DIGIT"
///     version = "0.3.1"
///     license = "MIT"
///     abi = { major = 1, minor = 0 }
///     needs = ["usb"]
///
///     [library]
///     linux-x86_64 = { path = "libdigit.so" }
///
///     [[provides]]
///     kind = "sensor"
///     key = "digit"
///     title = "DIGIT"
///     source = "real"
///     frame = { width = 240, height = 320, format = "rgb8" }
///     rate_hz = 60
///     gel = { opaque = true, markers = false, thickness_mm = 4.0 }
///     footprint = { shape = "rect", half_x_mm = 8.0, half_y_mm = 10.0 }
///     limits = { Pz_max_mm = 1.0, Fz_max_N = 2.0 }
///
///     [[provides.args]]
///     key = "exposure"
///     type = "number"
///     unit = "ms"
///     range = [0.1, 33.0]
///     default = 8.0
///     help = "of one frame"
/// "#)?;
/// let driver = manifest.drivers().next().expect("one");
/// assert_eq!(driver.key().as_str(), "org.example.digit/digit");
/// # Ok::<(), taceva_host::ManifestError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Manifest {
    /// Id of the plugin.
    pub id: PluginId,
    /// Display name.
    pub name: String,
    /// Version; the library must state the same.
    pub version: String,
    /// Licence.
    pub license: String,
    /// Interface version of the plugin.
    pub abi: AbiVersion,
    /// Outside resources that the plugin needs.
    pub needs: BTreeSet<DeclaredNeed>,
    /// Drivers and estimators, in the order of the manifest.
    pub provides: Vec<Provided>,
    libraries: BTreeMap<String, LibraryFile>,
    module: Option<PythonModule>,
}

/// Version of the C interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AbiVersion {
    /// Major version. Plugin and host must have the same major version.
    pub major: u32,
    /// Minor version. Plugin and host may have different minor versions.
    pub minor: u32,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    /// Format version, already checked by [`Versioned`].
    #[serde(rename = "manifest_version")]
    _version: u32,
    id: Spanned<String>,
    name: Spanned<String>,
    version: Spanned<String>,
    license: Spanned<String>,
    abi: Option<AbiVersion>,
    library: Option<Spanned<BTreeMap<String, Spanned<WrittenLibrary>>>>,
    program: Option<Spanned<WrittenProgram>>,
    #[serde(default)]
    needs: Vec<Spanned<String>>,
    provides: Spanned<Vec<WrittenProvides>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenLibrary {
    path: Spanned<String>,
    sha256: Option<Spanned<String>>,
}

/// Version key, which every format version has.
#[derive(Deserialize)]
struct Versioned {
    manifest_version: Spanned<u32>,
}

/// Invalid value with its byte range.
#[derive(Debug)]
struct Refused {
    span: Range<usize>,
    problem: String,
}

impl Refused {
    fn at<T>(written: &Spanned<T>, problem: impl Into<String>) -> Refused {
        Refused {
            span: written.span(),
            problem: problem.into(),
        }
    }
}

impl Manifest {
    /// Parses a manifest. Unknown keys are rejected.
    ///
    /// # Errors
    /// [`ManifestError`] for the first mistake, with its line.
    pub fn parse(text: &str) -> Result<Manifest, ManifestError> {
        if text.len() > BYTES_MAX {
            let problem = format!("{} bytes, expected at most {BYTES_MAX}", text.len());
            return Err(ManifestError::whole(problem));
        }
        // The version is checked first, because a newer manifest may have unknown keys.
        if let Ok(Versioned { manifest_version }) = toml::from_str(text) {
            let version = *manifest_version.get_ref();
            if version != VERSION {
                let problem =
                    format!("`manifest_version`: {version}, but this TacEva reads {VERSION}");
                return Err(ManifestError::at(text, &manifest_version.span(), problem));
            }
        }
        let written: Written =
            toml::from_str(text).map_err(|error| ManifestError::of_parser(text, &error))?;
        meant(written).map_err(|refused| ManifestError::at(text, &refused.span, refused.problem))
    }

    /// Library for `platform`, which has the form of [`platform`]; `None` if there is none.
    pub fn library(&self, platform: &str) -> Option<&LibraryFile> {
        self.libraries.get(platform)
    }

    /// Platforms that have a library.
    pub fn platforms(&self) -> impl Iterator<Item = &str> {
        self.libraries.keys().map(String::as_str)
    }

    /// Python module of the plugin; `None` for a library.
    pub fn module(&self) -> Option<&PythonModule> {
        self.module.as_ref()
    }

    /// Drivers of the plugin.
    pub fn drivers(&self) -> impl Iterator<Item = &Descriptor> {
        self.provides.iter().filter_map(|provided| match provided {
            Provided::Driver { descriptor, .. } => Some(&**descriptor),
            Provided::Estimator(_) => None,
        })
    }

    /// Estimators of the plugin.
    pub fn estimators(&self) -> impl Iterator<Item = &EstimatorInfo> {
        self.provides.iter().filter_map(|provided| match provided {
            Provided::Driver { .. } => None,
            Provided::Estimator(estimator) => Some(estimator),
        })
    }
}

impl Provided {
    /// Parses a library's description of a driver or estimator: a `[[provides]]` table without that header.
    ///
    /// # Errors
    /// As [`Manifest::parse`].
    pub fn parse(text: &str, id: &PluginId) -> Result<Provided, ManifestError> {
        if text.len() > BYTES_MAX {
            let problem = format!("{} bytes, expected at most {BYTES_MAX}", text.len());
            return Err(ManifestError::whole(problem));
        }
        let written: WrittenProvides =
            toml::from_str(text).map_err(|error| ManifestError::of_parser(text, &error))?;
        written
            .provided(id)
            .map_err(|refused| ManifestError::at(text, &refused.span, refused.problem))
    }

    /// Key by which users choose the driver or estimator.
    pub fn key(&self) -> &DriverKey {
        match self {
            Provided::Driver { descriptor, .. } => descriptor.key(),
            Provided::Estimator(estimator) => &estimator.key,
        }
    }
}

fn meant(written: Written) -> Result<Manifest, Refused> {
    let id: PluginId = (written.id.get_ref().parse())
        .map_err(|error| Refused::at(&written.id, format!("`id`: {error}")))?;
    let (libraries, module) = code(&written)?;
    let mut needs = BTreeSet::new();
    for need in &written.needs {
        let read: DeclaredNeed = (need.get_ref().parse())
            .map_err(|error| Refused::at(need, format!("`needs`: {error}")))?;
        if !needs.insert(read) {
            let problem = format!(
                "`needs`: `{}` is listed twice, expected once",
                shown(need.get_ref())
            );
            return Err(Refused::at(need, problem));
        }
    }
    let name = plain_text("name", &written.name)?;
    let version = plain_text("version", &written.version)?;
    let license = plain_text("license", &written.license)?;
    let count = written.provides.get_ref().len();
    if count == 0 || count > PROVIDES_MAX {
        let problem = format!("`provides`: {count} tables, expected 1 to {PROVIDES_MAX}");
        return Err(Refused::at(&written.provides, problem));
    }
    let mut keys = BTreeSet::new();
    let mut provides = Vec::with_capacity(count);
    for table in written.provides.into_inner() {
        let key = table.key.clone();
        provides.push(table.provided(&id)?);
        if !keys.insert(key.get_ref().clone()) {
            let problem = format!("`key`: two tables have the key `{}`", key.get_ref());
            return Err(Refused::at(&key, problem));
        }
    }
    for need in &written.needs {
        check_arguments(need, &needs, &provides)?;
    }
    Ok(Manifest {
        id,
        name,
        version,
        license,
        // The package that runs a module builds its tables, so the module has the interface version of that package.
        abi: written.abi.unwrap_or(AbiVersion {
            major: ABI_MAJOR,
            minor: ABI_MINOR,
        }),
        needs,
        provides,
        libraries,
        module,
    })
}

/// Rejects a need unless a driver declares all arguments in the need.
fn check_arguments(
    written: &Spanned<String>,
    needs: &BTreeSet<DeclaredNeed>,
    provides: &[Provided],
) -> Result<(), Refused> {
    let is_written = |need: &&DeclaredNeed| need.to_string() == *written.get_ref();
    let Some(need) = needs.iter().find(is_written) else {
        return Ok(());
    };
    let has_all = |provided: &Provided| match provided {
        Provided::Driver { descriptor, .. } => need.arguments().all(|key| {
            let mut specs = descriptor.arguments().iter();
            specs.any(|spec| spec.key == key)
        }),
        Provided::Estimator(_) => need.fixed().is_some(),
    };
    if provides.iter().any(has_all) {
        return Ok(());
    }
    let problem = format!(
        "`needs`: `{need}`: no driver has these arguments, expected keys of `[[provides.args]]`"
    );
    Err(Refused::at(written, problem))
}

/// Code of a plugin: libraries by platform, or a module.
type Code = (BTreeMap<String, LibraryFile>, Option<PythonModule>);

/// Reads either `[library]` or `[program]`.
fn code(written: &Written) -> Result<Code, Refused> {
    match (&written.library, &written.program) {
        (Some(library), None) if written.abi.is_some() => Ok((libraries(library)?, None)),
        (Some(library), None) => Err(Refused::at(library, "the key `abi` is missing")),
        (None, Some(program)) => Ok((BTreeMap::new(), Some(program.get_ref().module()?))),
        (Some(_), Some(program)) => {
            let problem =
                "`program`: a plugin is a library or a program, but `library` is given too";
            Err(Refused::at(program, problem))
        }
        (None, None) => {
            let problem = "the key `library` is missing; a plugin in Python has `program` instead";
            Err(Refused::at(&written.id, problem))
        }
    }
}

fn libraries(
    written: &Spanned<BTreeMap<String, Spanned<WrittenLibrary>>>,
) -> Result<BTreeMap<String, LibraryFile>, Refused> {
    if written.get_ref().is_empty() {
        let problem = format!(
            "`library`: names no platform, expected `{} = {{ path = … }}`",
            platform()
        );
        return Err(Refused::at(written, problem));
    }
    let mut libraries = BTreeMap::new();
    for (platform, library) in written.get_ref() {
        if !PLATFORMS.contains(&platform.as_str()) {
            let help = suggestion(platform, &PLATFORMS);
            let problem = format!("`{}`: unknown platform, {help}", shown(platform));
            return Err(Refused::at(library, problem));
        }
        let WrittenLibrary { path, sha256 } = library.get_ref();
        if let Some(fault) = path_fault(path.get_ref()) {
            let problem = format!("`path`: {:?}, {fault}", shown(path.get_ref()));
            return Err(Refused::at(path, problem));
        }
        let sha256 = sha256.as_ref().map(|digest| {
            Sha256Digest::from_hex(digest.get_ref())
                .ok_or_else(|| Refused::at(digest, "`sha256`: expected 64 hexadecimal digits"))
        });
        let file = LibraryFile {
            path: path.get_ref().clone(),
            sha256: sha256.transpose()?,
        };
        libraries.insert(platform.clone(), file);
    }
    Ok(libraries)
}

/// Checks a display text: one line of 1 to 200 bytes.
fn plain_text(key: &str, written: &Spanned<String>) -> Result<String, Refused> {
    let text = written.get_ref();
    let is_plain = !text.trim().is_empty() && text.len() <= 200 && !text.contains(char::is_control);
    if is_plain {
        Ok(text.clone())
    } else {
        let problem = format!(
            "`{key}`: {:?}, expected one line of 1 to 200 bytes",
            shown(text)
        );
        Err(Refused::at(written, problem))
    }
}

#[cfg(test)]
mod tests;
