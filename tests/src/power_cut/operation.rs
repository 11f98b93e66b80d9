//! Operations of a program that change a disk or inform its user.

/// Number of a file or a folder, independent of its names; the watched folder is 0.
pub type ObjectId = usize;

/// The watched folder itself.
pub const ROOT: ObjectId = 0;

/// Operation on the watched folder, or printed line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Operation {
    /// Creation of a file or folder; its number is the next free one.
    Create {
        /// Parent folder.
        folder: ObjectId,
        /// Name of the new object.
        name: String,
        /// File or folder.
        kind: Kind,
    },
    /// Additional name of an existing object.
    Link {
        /// Parent folder.
        folder: ObjectId,
        /// The name.
        name: String,
        /// Object of the name.
        object: ObjectId,
    },
    /// Removal of a name.
    Remove {
        /// Parent folder.
        folder: ObjectId,
        /// The name.
        name: String,
    },
    /// Renaming, which replaces an object of the new name.
    Rename {
        /// Folder and name before.
        from: (ObjectId, String),
        /// Folder and name after.
        to: (ObjectId, String),
    },
    /// Exchange of two names at once.
    Exchange {
        /// First folder and name.
        one: (ObjectId, String),
        /// Second folder and name.
        other: (ObjectId, String),
    },
    /// Write of bytes to a file.
    Write {
        /// The file.
        file: ObjectId,
        /// Offset, bytes.
        offset: usize,
        /// The bytes.
        bytes: Vec<u8>,
    },
    /// Truncation of a file, or extension with zeros.
    Resize {
        /// The file.
        file: ObjectId,
        /// New length, bytes.
        length: usize,
    },
    /// Sync of a file or folder.
    Sync {
        /// Synced object.
        object: ObjectId,
        /// Number of operations applied before the call began. The sync covers only these operations.
        covers: usize,
    },
    /// Line on standard output. Readers rely on the line from now on.
    Print(String),
}

/// A file or a folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// File.
    File,
    /// Folder.
    Folder,
}
