//! Operations of a program that change a disk or inform its user.

/// Number of a file or a folder, independent of its names; the watched folder is 0.
pub type ObjectId = usize;

/// Number of the watched folder.
pub const ROOT: ObjectId = 0;

/// Operation on the watched folder, or printed line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Operation {
    /// Creation of a file or folder; its number is the next free one.
    Create {
        /// Parent folder of the new object.
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
        /// The additional name.
        name: String,
        /// Object that gets the name.
        object: ObjectId,
    },
    /// Removal of a name.
    Remove {
        /// Parent folder.
        folder: ObjectId,
        /// The removed name.
        name: String,
    },
    /// Renaming of an object. It replaces any object that has the new name.
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
        /// File to which the bytes are written.
        file: ObjectId,
        /// Offset of the first byte in the file, bytes.
        offset: usize,
        /// Bytes that are written.
        bytes: Vec<u8>,
    },
    /// Truncation of a file, or extension with zeros.
    Resize {
        /// File whose length changes.
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
    /// A file.
    File,
    /// A folder.
    Folder,
}
