//! Operations of a program that change a disk, or that its user relies on.

/// The number of a file or a folder, which it keeps whatever it is called; the watched folder is 0.
pub type ObjectId = usize;

/// The watched folder itself.
pub const ROOT: ObjectId = 0;

/// What a program did to the watched folder, or printed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Operation {
    /// A new file or folder; its number is the next free one.
    Create {
        /// Where.
        folder: ObjectId,
        /// Its name.
        name: String,
        /// Which of the two.
        kind: Kind,
    },
    /// One more name for something that is there.
    Link {
        /// Where.
        folder: ObjectId,
        /// The name.
        name: String,
        /// What it names.
        object: ObjectId,
    },
    /// A name that is taken away.
    Remove {
        /// Where.
        folder: ObjectId,
        /// The name.
        name: String,
    },
    /// A name that becomes another, replacing what had it.
    Rename {
        /// Folder and name before.
        from: (ObjectId, String),
        /// Folder and name after.
        to: (ObjectId, String),
    },
    /// Two names that change places at once.
    Exchange {
        /// Folder and name of the one.
        one: (ObjectId, String),
        /// Folder and name of the other.
        other: (ObjectId, String),
    },
    /// Bytes that a file got.
    Write {
        /// The file.
        file: ObjectId,
        /// From which byte on.
        offset: usize,
        /// The bytes.
        bytes: Vec<u8>,
    },
    /// A file that was cut or filled up with zeros.
    Resize {
        /// The file.
        file: ObjectId,
        /// Its length now.
        length: usize,
    },
    /// A file or folder that was made durable.
    Sync {
        /// Which.
        object: ObjectId,
        /// Operations that had been applied when the call began: only these are covered.
        covers: usize,
    },
    /// A line on standard output, on which its reader relies from now on.
    Print(String),
}

/// A file or a folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Bytes.
    File,
    /// Names.
    Folder,
}
