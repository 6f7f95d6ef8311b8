//! Global_Control: a command to several slaves at once. Nobody answers.
//!
//! Layout, 2 bytes: command (1), groups (1).

use super::{Body, Kind};
use crate::field::{Bits, Direction, Message, Name, Role, Spec};
use crate::message;
use crate::walk::{Telegram, Walk, Walker};

pub static REQUEST: Kind = Kind {
    sap: Some(58),
    direction: Direction::Request,
    spec: Spec::new("global_control_request", "Control command")
        .short("Global_Control")
        .note(
            "Tells slaves at once to freeze their inputs or to hold their outputs, or that they clear them.",
        )
        .source(SOURCE),
    new: |_| Box::new(GlobalControl { command: 0, groups: 0 }),
};

pub struct GlobalControl {
    pub command: u8,
    pub groups: u8,
}

impl Telegram for GlobalControl {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        w.u8(&COMMAND, &mut self.command)?;
        w.u8(&GROUP_SELECT, &mut self.groups)
    }
}

impl Body for GlobalControl {
    fn meaning(&self, who: Message) -> Message {
        let command = super::number_meaning(&COMMAND, self.command);
        let groups = super::number_meaning(&GROUP_SELECT, self.groups);
        message!("command {who} ({groups}): {command}", who = who, groups = groups, command = command)
    }
}

static COMMAND: Spec = Spec::new("command", "Command")
    .role(Role::Function)
    .note("What the slaves are to do. Where a command and its opposite are both set, the opposite wins.")
    .source(SOURCE)
    .names(&[Name { value: 0, label: "normal operation", note: "Nothing is to change." }])
    .bits(&[
        Bits::reserved(0, 1),
        Bits::flag(1, "clear_data", "clear outputs").note("The master is not in operation."),
        Bits::flag(2, "unfreeze", "unfreeze inputs"),
        Bits::flag(3, "freeze", "freeze inputs").note("Inputs keep their value until the next freeze."),
        Bits::flag(4, "unsync", "release outputs (unsync)"),
        Bits::flag(5, "sync", "hold outputs (sync)").note("Outputs change only with each sync."),
        Bits::reserved(6, 2),
    ]);

static GROUP_SELECT: Spec = Spec::new("group_select", "Groups")
    .role(Role::Unit)
    .note("Which groups of slaves are meant.")
    .source(SOURCE)
    .names(&[Name { value: 0, label: "all groups", note: "Every slave, in a group or not." }])
    .bits(GROUPS);

/// A slave can be in several of eight groups.
pub static GROUPS: &[Bits] = &[
    Bits::flag(0, "group_1", "group 1"),
    Bits::flag(1, "group_2", "group 2"),
    Bits::flag(2, "group_3", "group 3"),
    Bits::flag(3, "group_4", "group 4"),
    Bits::flag(4, "group_5", "group 5"),
    Bits::flag(5, "group_6", "group 6"),
    Bits::flag(6, "group_7", "group 7"),
    Bits::flag(7, "group_8", "group 8"),
];

const SOURCE: &str = "EN 50170, volume 2; KEB COMBIVERT F5 PROFIBUS-DP operator, 6.1";
