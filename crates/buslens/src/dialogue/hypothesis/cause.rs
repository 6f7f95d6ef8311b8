/// What can happen to a telegram.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Cause {
    CheckSwapped,
    /// The check differs in one hex digit.
    CheckDigit,
    CheckWrong,
    CheckMissing,
    /// The check is that of all bytes but the address.
    CheckWithoutAddress,
    /// The check is right for another start value or another CRC.
    CheckOfOtherKind(&'static str),
    /// The check stands in another telegram of the same log.
    CheckCopied,
    BitFlipped,
    ByteChanged,
    DigitsSwapped,
    /// A digit was lost when it was typed or copied.
    DigitLost,
    BytesSwapped,
    /// The two bytes of each word have changed places.
    WordsSwapped,
    ByteDoubled,
    ByteExtra,
    RegisterExtra,
    ByteMissing,
    RegisterMissing,
    /// Bytes 11h or 13h were taken for flow control.
    FlowControl,
    /// 00 or FF before or behind it, as when the line turns round.
    LineTurn,
    LeadingBytes,
    TrailingBytes,
    /// Two right telegrams, one behind the other.
    Joined,
    /// The request is in front of its response.
    EchoInFront,
    /// Its end is missing.
    Cut,
    /// It is of another protocol.
    OtherProtocol,
    /// The manual prints it so, with slips.
    Misprint {
        section: &'static str,
        slips: &'static str,
    },
}

/// How often it happens, as the number of times that it has to be halved from "always". From what
/// people ask in forums and from the misprints of manuals: single changed bits and bytes, bytes lost
/// and left over on the line are everyday; a check of another kind is not.
const RARITY: &[(Cause, u32)] = &[
    (Cause::OtherProtocol, 1),
    (Cause::EchoInFront, 1),
    (Cause::Joined, 2),
    (Cause::LineTurn, 2),
    (Cause::BitFlipped, 2),
    (Cause::CheckSwapped, 3),
    (Cause::FlowControl, 3),
    (Cause::ByteChanged, 4),
    (Cause::ByteMissing, 4),
    (Cause::ByteDoubled, 4),
    (Cause::TrailingBytes, 4),
    (Cause::LeadingBytes, 4),
    (Cause::Cut, 4),
    (Cause::DigitLost, 1),
    (Cause::CheckDigit, 5),
    (Cause::CheckWrong, 5),
    (Cause::CheckMissing, 5),
    (Cause::CheckCopied, 5),
    (Cause::CheckWithoutAddress, 5),
    (Cause::ByteExtra, 5),
    (Cause::DigitsSwapped, 5),
    (Cause::WordsSwapped, 5),
    (Cause::BytesSwapped, 6),
    (Cause::RegisterMissing, 6),
    (Cause::RegisterExtra, 6),
];

/// For what is not in the list: checks of other kinds.
const RAREST: u32 = 6;

impl Cause {
    /// How rare it is, in halvings.
    pub fn rarity(self) -> u32 {
        RARITY.iter().find(|(cause, _)| *cause == self).map_or(RAREST, |(_, rarity)| *rarity)
    }

    /// The stable word of exports.
    pub const fn key(self) -> &'static str {
        match self {
            Self::CheckSwapped => "check-swapped",
            Self::CheckDigit => "check-digit",
            Self::CheckWrong => "check-wrong",
            Self::CheckMissing => "check-missing",
            Self::CheckWithoutAddress => "check-without-address",
            Self::CheckOfOtherKind(_) => "check-other-kind",
            Self::CheckCopied => "check-copied",
            Self::BitFlipped => "bit-flipped",
            Self::ByteChanged => "byte-changed",
            Self::DigitsSwapped => "digits-swapped",
            Self::DigitLost => "digit-lost",
            Self::BytesSwapped => "bytes-swapped",
            Self::WordsSwapped => "words-swapped",
            Self::ByteDoubled => "byte-doubled",
            Self::ByteExtra => "byte-extra",
            Self::RegisterExtra => "register-extra",
            Self::ByteMissing => "byte-missing",
            Self::RegisterMissing => "register-missing",
            Self::FlowControl => "flow-control",
            Self::LineTurn => "line-turn",
            Self::LeadingBytes => "leading-bytes",
            Self::TrailingBytes => "trailing-bytes",
            Self::Joined => "joined",
            Self::EchoInFront => "echo-in-front",
            Self::Cut => "cut",
            Self::OtherProtocol => "other-protocol",
            Self::Misprint { .. } => "misprint",
        }
    }
}
