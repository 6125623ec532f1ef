"""Tables of an answer, with a number in every cell: for sheets of a workbook and for CSV."""
