//! Restrictions in force for a child.

use std::fmt;

use super::Need;
use crate::child::wire::fields;

/// Restrictions in force for a child. The child reports them before it loads code that could report false values.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Isolation {
    /// Landlock version that restricts files, ports and other processes; `None` if the kernel has none.
    pub landlock: Option<u32>,
    /// Number of allowed system calls; `None` if they are not filtered.
    pub system_calls: Option<u32>,
    /// User that the child switched to; `None` if it kept the user that started it.
    pub user: Option<u32>,
    /// Limit of address space, bytes.
    pub memory: u64,
    /// Outside resources that the child may use.
    pub needs: Vec<Need>,
    /// True if the child may map code at any time, not only during loading.
    pub takes_code: bool,
}

impl Isolation {
    /// True if Landlock has at least version 6 and system calls are filtered.
    pub fn is_whole(&self) -> bool {
        self.landlock
            .is_some_and(|version| version >= LANDLOCK_WHOLE)
            && self.system_calls.is_some()
    }
}

/// First Landlock version that covers files, ports and signals.
pub(super) const LANDLOCK_WHOLE: u32 = 6;

impl fmt::Display for Isolation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a process of its own")?;
        match self.landlock {
            Some(version) => write!(f, ", files and ports closed by Landlock {version}")?,
            None => f.write_str(", files and ports open: this kernel has no Landlock")?,
        }
        match self.system_calls {
            Some(count) => write!(f, ", {count} system calls allowed")?,
            None => f.write_str(", every system call allowed")?,
        }
        if let Some(user) = self.user {
            write!(f, ", user {user}")?;
        }
        write!(f, ", {} MiB of memory", self.memory >> 20)?;
        if self.takes_code {
            f.write_str(", may load code at any time")?;
        }
        if !self.needs.is_empty() {
            f.write_str(", may reach")?;
            for (position, need) in self.needs.iter().enumerate() {
                write!(f, "{}{need}", if position == 0 { " " } else { ", " })?;
            }
        }
        Ok(())
    }
}

fields!(Isolation {
    landlock,
    system_calls,
    user,
    memory,
    needs,
    takes_code
});

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_says_in_words_what_is_enforced_and_what_is_not() {
        let whole = Isolation {
            landlock: Some(7),
            system_calls: Some(60),
            user: Some(65_534),
            memory: 4 << 30,
            needs: vec!["usb".parse().expect("a need")],
            takes_code: false,
        };
        assert!(whole.is_whole());
        assert_eq!(
            whole.to_string(),
            "a process of its own, files and ports closed by Landlock 7, 60 system calls allowed, user 65534, 4096 MiB of memory, may reach usb"
        );
        let open = Isolation {
            takes_code: true,
            ..whole
        };
        assert!(
            open.to_string()
                .contains("MiB of memory, may load code at any time, may reach")
        );
        let bare = Isolation::default();
        assert!(!bare.is_whole());
        assert!(bare.to_string().contains("this kernel has no Landlock"));
    }
}
