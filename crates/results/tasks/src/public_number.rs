//! Public programs, and their numbers with the correct numbers.

use std::fmt;
use std::str::FromStr;

use serde::{Serialize, Serializer};
use taceva_core::{nearest, shown};

/// Public program whose numbers can be computed in addition to the correct numbers. More programs may be added.
///
/// ```
/// use taceva_tasks::PublicProgram;
/// assert_eq!("sparsh".parse::<PublicProgram>(), Ok(PublicProgram::Sparsh));
/// let refused = "sparch".parse::<PublicProgram>();
/// assert!(refused.is_err_and(|error| error.ends_with("did you mean sparsh?")));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum PublicProgram {
    /// Sparsh, with the benchmark TacBench.
    Sparsh,
    /// The linear classifier of Touch and Go.
    TouchAndGo,
    /// The experiments of NormalFlow.
    NormalFlow,
    /// The benchmark of ObjectFolder.
    ObjectFolder,
}

impl PublicProgram {
    /// All public programs.
    pub const ALL: [PublicProgram; 4] = [
        PublicProgram::Sparsh,
        PublicProgram::TouchAndGo,
        PublicProgram::NormalFlow,
        PublicProgram::ObjectFolder,
    ];

    /// Name in commands and files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            PublicProgram::Sparsh => "sparsh",
            PublicProgram::TouchAndGo => "touch-and-go",
            PublicProgram::NormalFlow => "normalflow",
            PublicProgram::ObjectFolder => "objectfolder",
        }
    }

    /// Tasks that the program scores.
    #[must_use]
    pub const fn of_tasks(self) -> &'static str {
        match self {
            PublicProgram::Sparsh | PublicProgram::TouchAndGo => "classes",
            PublicProgram::NormalFlow | PublicProgram::ObjectFolder => "poses",
        }
    }
}

impl fmt::Display for PublicProgram {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for PublicProgram {
    type Err = String;
    fn from_str(word: &str) -> Result<PublicProgram, String> {
        let mut programs = PublicProgram::ALL.into_iter();
        programs.find(|own| own.name() == word).ok_or_else(|| {
            let names = PublicProgram::ALL.map(PublicProgram::name);
            let meant = nearest(word, names)
                .map_or_else(String::new, |name| format!("; did you mean {name}?"));
            format!(
                "`{}`: expected one of {}{meant}",
                shown(word),
                names.join(", ")
            )
        })
    }
}

impl Serialize for PublicProgram {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

/// Number as a public program computes it, with the correct number.
///
/// ```
/// use taceva_tasks::{Classes, PublicProgram, TaskState};
/// let mut classes = Classes::new(["cloth", "stone"], None)?;
/// classes.push("clip 1", "cloth", "cloth")?;
/// let mut state = TaskState::new("material", "class", "clip");
/// state.classes = Some(classes);
/// let numbers = state.as_published(PublicProgram::TouchAndGo);
/// assert_eq!((numbers[0].number.as_str(), numbers[0].value), ("top-5", 1.0));
/// # Ok::<(), taceva_tasks::TaskError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct PublicNumber {
    /// Public program that computes the number.
    pub program: PublicProgram,
    /// Name of the number, as the program prints it.
    pub number: String,
    /// Value by the definition of the program.
    pub value: f64,
    /// Unit of both values; `None` for pure numbers.
    pub unit: Option<&'static str>,
    /// Correct value; `None` if the task has no data for it.
    pub right: Option<f64>,
    /// The reason for the difference, in one line.
    pub difference: String,
}
