"""Machines and answers as workbooks of a spreadsheet."""
