/// What a text says of bytes in it, besides the bytes themselves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Facts {
    /// Digits behind a colon, as Modbus ASCII has them.
    pub colon: bool,
    /// A row of a dump, or a place that a person marked.
    pub dumped: bool,
    /// A column of several lines.
    pub column: bool,
    /// Nothing else is in its line.
    pub bare: bool,
    /// The text says who sends it, right before it or in the line above.
    pub said: bool,
    /// A colon, an equals sign or the like stands before it.
    pub labelled: bool,
    /// It stands in brackets or quotes of its own.
    pub wrapped: bool,
    /// It is, or is of, an array in the source of a program.
    pub array: bool,
    /// Its numbers have a mark each, and some have two bytes, or it is one of four: `0x01, 0x0203`, `0x01020304`.
    pub words: bool,
    /// Commas stand between its numbers.
    pub listed: bool,
    /// Commas stand between its numbers, and each has one digit, as settings and counters have, too; or all of it is
    /// one number of decimal digits that begins with none, as serial numbers are; or it could be dialled.
    pub digits: bool,
    /// Its numbers have a prefix, an h, or are escapes: certainly bytes.
    pub marked: bool,
    /// A number beside it or in the line above says how many bytes it has.
    pub counted: bool,
    /// Behind it stands a word for its check, in brackets or behind an arrow: `[CRC]`, `-> CRC`.
    pub check_named: bool,
    /// Words that telegrams have near them stand in its line: frame, CRC.
    pub of_telegrams: bool,
    /// Words say that it was left over or thrown away.
    pub of_leftovers: bool,
    /// An ellipsis or a placeholder shows that more was there.
    pub abridged: bool,
    /// Characters in it are no hex, as slips of typing are.
    pub slips: bool,
    /// A byte or a few at the end of a line, which may be the rest of a telegram.
    pub rest: bool,
    /// Pieces with the same number stand in the same way in their lines: behind the same word and the same
    /// mark, written in the same way.
    pub shape: u32,
}
