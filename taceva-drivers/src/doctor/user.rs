//! User who runs the program, and the user's permissions.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::Metadata;

/// User who runs the program, with the groups of this process and the names of all groups.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct User {
    id: u32,
    groups: BTreeSet<u32>,
    group_names: BTreeMap<u32, String>,
    /// Groups that list the user as a member. This process may lack a group that the user joined after login.
    entitled: BTreeSet<u32>,
}

impl User {
    /// Parses the user from the text of the Linux files `/proc/self/status`, `/etc/passwd` and `/etc/group`. `None` if `status` lacks the user or
    /// group ids.
    pub(super) fn parse(status: &str, passwords: &str, groups: &str) -> Option<User> {
        let numbers = |label: &str| -> Option<Vec<u32>> {
            let line = status.lines().find_map(|line| line.strip_prefix(label))?;
            line.split_whitespace()
                .map(|number| number.parse().ok())
                .collect()
        };
        // Real, effective, saved and file-system id; the last one applies to opening files.
        let id = *numbers("Uid:")?.last()?;
        let mut own_groups: BTreeSet<u32> = numbers("Groups:")?.into_iter().collect();
        own_groups.insert(*numbers("Gid:")?.last()?);
        let name = passwords.lines().find_map(|line| {
            let mut fields = line.split(':');
            let name = fields.next()?;
            (fields.nth(1)?.parse() == Ok(id)).then_some(name)
        });
        let mut user = User {
            id,
            groups: own_groups,
            group_names: BTreeMap::new(),
            entitled: BTreeSet::new(),
        };
        for line in groups.lines() {
            let fields: Vec<&str> = line.split(':').collect();
            if let [group, _, number, members] = fields[..]
                && let Ok(number) = number.parse()
            {
                user.group_names.insert(number, group.to_owned());
                if members.split(',').any(|member| Some(member) == name) {
                    user.entitled.insert(number);
                }
            }
        }
        Some(user)
    }

    /// Remedy that gives the user access to the device `path`; `None` if the user already has access.
    pub(super) fn remedy(&self, path: &str, metadata: &Metadata) -> Option<String> {
        let owned = Ownership::of(metadata)?;
        const READ_WRITE: u32 = 0o6;
        let permits = |shift: u32| (owned.mode >> shift) & READ_WRITE == READ_WRITE;
        let is_member = self.groups.contains(&owned.group);
        // The first matching class decides, as in the kernel.
        let permitted = match () {
            () if self.id == 0 => true,
            () if self.id == owned.owner => permits(6),
            () if is_member => permits(3),
            () => permits(0),
        };
        if permitted {
            return None;
        }
        let group = match self.group_names.get(&owned.group) {
            Some(name) => name.clone(),
            None => owned.group.to_string(),
        };
        Some(if !permits(3) || is_member || self.id == owned.owner {
            format!(
                "its mode is {:03o}: permit the group to read and write it with a udev rule, MODE=\"0660\"",
                owned.mode & 0o777
            )
        } else if self.entitled.contains(&owned.group) {
            format!(
                "log out and in again: this session began before you joined the group `{group}`"
            )
        } else {
            format!(
                "join the group `{group}` and log in again: sudo usermod -aG {group} \"$USER\" ({path})"
            )
        })
    }
}

/// Owner, group and mode of a file.
struct Ownership {
    owner: u32,
    group: u32,
    mode: u32,
}

impl Ownership {
    #[cfg(unix)]
    fn of(metadata: &Metadata) -> Option<Ownership> {
        use std::os::unix::fs::MetadataExt;
        Some(Ownership {
            owner: metadata.uid(),
            group: metadata.gid(),
            mode: metadata.mode(),
        })
    }

    #[cfg(not(unix))]
    fn of(_: &Metadata) -> Option<Ownership> {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STATUS: &str = "Name:\ttaceva\nUid:\t1000\t1000\t1000\t1000\nGid:\t1000\t1000\t1000\t1000\nGroups:\t27 44 \n";

    #[test]
    fn a_user_is_read_from_the_tables_of_the_system() {
        let passwords = "root:x:0:0::/:/bin/sh\nann:x:1000:1000::/:/bin/sh";
        let groups = "video:x:44:\ndialout:x:20:bob,ann\nodd line\n";
        let user = User::parse(STATUS, passwords, groups).expect("complete");
        assert_eq!(user.id, 1000);
        assert_eq!(user.groups, BTreeSet::from([27, 44, 1000]));
        assert_eq!(user.entitled, BTreeSet::from([20]));
        assert_eq!(user.group_names[&44], "video");
    }

    #[test]
    fn a_status_that_does_not_say_who_gives_nobody() {
        for status in [
            "",
            "Uid:\t",
            "Uid:\tx\nGid:\t1\nGroups:\t",
            "Uid:\t1 1 1 1\nGid:\t1",
        ] {
            assert_eq!(User::parse(status, "", ""), None, "{status:?}");
        }
    }
}
